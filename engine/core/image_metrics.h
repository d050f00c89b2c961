#pragma once

#include <span>
#include <string>

#include "engine/core/image.h"

namespace tyndall {

/// Throws Error that names `name` and the first pixel (from the top left, row by row) of the first three channels
/// that is not finite.
void require_finite(const Image& image, const std::string& name);

[[nodiscard]] double mean_value(const Image& image);  ///< over pixels and the first three channels

/// compare_images().rmse over the mean of the reference; +inf against black, 0 when both are.
[[nodiscard]] double relative_rmse(const Image& a, const Image& reference);

/// Red where any of the first three channels differs by more than `threshold` (of 0..1), else the reference,
/// darkened.
[[nodiscard]] Image threshold_picture(const Image& a, const Image& reference, float threshold);

/// Linear radiance as display values 0..1: sRGB encoded, 1 at `white` and above, three channels.
[[nodiscard]] Image radiance_to_display(const Image& radiance, float white);
/// A white for radiance_to_display(): 99 % of the values of the first three channels are at most this; the largest
/// value where that is 0, and 1 for black.
[[nodiscard]] float display_white(const Image& radiance);

/// Mean absolute change from frame to frame of a static scene, over the mean of all frames. At least two frames.
[[nodiscard]] double flicker(std::span<const Image> frames);

/// What is left of a light `frame` shows after it was switched off: mean(frame - off) / mean(on - off), where `on`
/// and `off` are settled frames with and without it. 0: nothing; 1: all; negative: too dark.
[[nodiscard]] double residual_light(const Image& frame, const Image& on, const Image& off);

}  // namespace tyndall
