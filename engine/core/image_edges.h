#pragma once

#include "engine/core/image.h"

namespace tyndall {

/// 1 within `radius` px (of a square) of a depth edge, else 0; one channel. `depth` holds view depths in m, 0 for
/// the sky. An edge is where neither side's plane goes on to the other by a tenth of the nearer one's inverse
/// depth, so that floors seen at a grazing angle and creases have none.
[[nodiscard]] Image edge_band(const Image& depth, int radius);

/// relative_rmse() of the pixels inside of a mask (> 0) and of those outside, each over the mean of the reference
/// there. Throws Error when sizes differ. A part without pixels or without difference has the error 0.
struct MaskedError {
    double inside, outside;
    double share;  ///< of the pixels that lie inside
};
[[nodiscard]] MaskedError masked_relative_rmse(const Image& a, const Image& reference, const Image& mask);

}  // namespace tyndall
