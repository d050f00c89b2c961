#pragma once

#include <vector>

namespace tyndall {

/// A centred 1D filter of 2 r + 1 taps; the 2D filters of FLIP are products and sums of products of these.
using FlipKernel = std::vector<float>;

struct FlipKernels {
    // Contrast sensitivity of the eye, each of sum 1: blue-yellow is a sum of two Gaussians.
    FlipKernel achromatic, red_green;
    FlipKernel blue_yellow[2];
    float blue_yellow_share[2];  ///< of sum 1
    // Features: a Gaussian of sum 1, and its first and second derivative with positive taps of sum 1 and negative
    // ones of sum -1.
    FlipKernel gaussian, edge, point;
    int radius;  ///< the largest of all
};
/// Andersson et al. 2020, sections 4.1.1 and 4.2. `pixels_per_degree`: 1 to 7404, else throws Error.
[[nodiscard]] FlipKernels flip_kernels(double pixels_per_degree);

}  // namespace tyndall
