#pragma once

#include "engine/core/image.h"

namespace tyndall {

/// A display of 0.7 m width and 3840 px seen from 0.7 m, as in the papers.
constexpr double flip_pixels_per_degree = 67.0206;

/// ꟻLIP: what a person who flips between two pictures sees, per pixel, 0 (no difference) to 1; 1 channel. Andersson et
/// al. 2020, "FLIP: A Difference Evaluator for Alternating Images". First three channels, sRGB encoded, 0..1 (values
/// outside are clamped). Throws Error when sizes differ.
[[nodiscard]] Image flip_error(const Image& test, const Image& reference,
                               double pixels_per_degree = flip_pixels_per_degree);

/// The form for linear radiance: the largest LDR error per pixel over a range of exposures that the reference sets.
/// Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images".
[[nodiscard]] Image hdr_flip_error(const Image& test, const Image& reference,
                                   double pixels_per_degree = flip_pixels_per_degree);

}  // namespace tyndall
