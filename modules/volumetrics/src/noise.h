#pragma once

#include <vector>

#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// The tile of sample offsets in (0, 1), rows of `size`: of bayer and white_tile; else the one value 0.5.
[[nodiscard]] std::vector<float> noise_tile(Noise noise, int size);

/// Its side: 1 where there is no tile.
[[nodiscard]] int noise_side(const Settings& settings);

}  // namespace tyndall::volumetrics
