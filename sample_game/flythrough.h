#pragma once

#include <filesystem>

#include "session/session.h"

namespace tyndall {

struct FlythroughOptions {
    std::filesystem::path out;
    double frames_per_second = 4;  ///< fixed time steps, as the paper throttles: every run draws the same frames
    double duration = 0;           ///< s; 0: the whole path
};

/// Draws the level's "flythrough" animation in fixed steps and writes into `out`: frames.csv (milliseconds per
/// frame and pass), summary.csv and summary.md (the frame breakdown of the ray-marching thesis, table 4.3: total,
/// march, filter, composite; mean, standard deviation, variance), and a still PLACE.png per place of the path (all
/// of them, however short `duration`). Throws Error when the scene has no such animation.
void fly_through(Session& session, const FlythroughOptions& options);

}  // namespace tyndall
