#pragma once

#include <span>

#include "engine/core/image.h"

namespace tyndall {

[[nodiscard]] double mean_value(const Image& image);  ///< over pixels and the first three channels

/// compare_images().rmse over the mean of the reference; +inf against black, 0 when both are.
[[nodiscard]] double relative_rmse(const Image& a, const Image& reference);

/// Red where any of the first three channels differs by more than `threshold` (of 0..1), else the reference, darkened.
[[nodiscard]] Image threshold_picture(const Image& a, const Image& reference, float threshold);

/// Mean absolute change from frame to frame of a static scene, over the mean of all frames. At least two frames.
[[nodiscard]] double flicker(std::span<const Image> frames);

/// What is left of a light `frame` shows after it was switched off: mean(frame - off) / mean(on - off), where `on` and
/// `off` are settled frames with and without it. 0: nothing; 1: all; negative: too dark.
[[nodiscard]] double residual_light(const Image& frame, const Image& on, const Image& off);

}  // namespace tyndall
