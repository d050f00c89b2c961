#pragma once

#include <vector>

#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// The tile of sample offsets in (0, 1), rows of `dither_size`; the one value 0.5 without dithering.
[[nodiscard]] std::vector<float> dither_tile(Dither dither, int size);

}  // namespace tyndall::volumetrics
