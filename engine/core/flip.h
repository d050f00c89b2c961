#pragma once

#include "engine/core/image.h"

namespace tyndall {

/// A display of 0.7 m width and 3840 px seen from 0.7 m, as in the papers.
constexpr double flip_pixels_per_degree = 67.0206;

/// ꟻLIP: what a person who flips between two pictures sees, per pixel, 0 (no difference) to 1; 1 channel. Andersson
/// et al. 2020, "FLIP: A Difference Evaluator for Alternating Images". First three channels, sRGB encoded, 0..1
/// (values outside are clamped). Throws Error when sizes differ, with fewer than three channels, and for values
/// that are not finite.
[[nodiscard]] Image flip_error(const Image& test, const Image& reference,
                               double pixels_per_degree = flip_pixels_per_degree);

/// The form for linear radiance: the largest LDR error per pixel over a range of exposures that the reference sets.
/// Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images". Negative values count as 0.
[[nodiscard]] Image hdr_flip_error(const Image& test, const Image& reference,
                                   double pixels_per_degree = flip_pixels_per_degree);

/// The exposures of hdr_flip_error(), in stops, evenly spaced: at `start` the brightest pixel of the reference, at
/// `stop` the median one reaches 0.85 of white on the ACES curve. Where more than half of the reference is black
/// the median is that of the other pixels (the paper's would be infinite); for a black reference both are 0.
struct FlipExposures {
    double start = 0;
    double stop = 0;
    int count = 2;  ///< max(2, ceil(stop - start))
};
[[nodiscard]] FlipExposures flip_exposures(const Image& reference);

/// An error map as a picture: the magma colour map, black (0) over purple and orange to pale yellow (1).
[[nodiscard]] Image flip_heatmap(const Image& error);

}  // namespace tyndall
