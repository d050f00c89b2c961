#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

/// What lies in the range of a lamp that moved, came or went since the frame before.
struct ChangedLamp {
    glm::vec3 position{0};  ///< m
    float range = 0;        ///< m
    float frames = 1;       ///< that a mean of its light may be taken over, >= 1
};

/// Lamps are told apart by place, range and axis, for their indices may be others in each frame. One that moved by
/// 0.1 m, or turned as far at half its range, is worth one frame, less movement more frames; so is one that came or
/// went.
[[nodiscard]] std::vector<ChangedLamp> changed_lamps(const std::vector<Lamp>& before, const std::vector<Lamp>& now);

}  // namespace tyndall::volumetrics
