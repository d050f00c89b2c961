// The camera path through the six places.
#pragma once

#include <string>
#include <vector>

#include "tools/level/level.h"

namespace tyndall::level {

struct Waypoint {
    float time;  // s, a multiple of the key spacing
    Pose pose;
    std::string place;  // empty: only a point on the way
};

// Smooth through all waypoints (cubic Hermite with finite-difference slopes), at rest at both ends.
Pose pose_at(const std::vector<Waypoint>& way, float time);

// Translation and rotation keys every 0.1 s for `node`, and the times of the places in the extras.
Animation flythrough(const std::vector<Waypoint>& way, int node);

}  // namespace tyndall::level
