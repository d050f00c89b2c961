#include "engine/core/flip_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"

namespace tyndall {
namespace {

constexpr double pi = std::numbers::pi;

/// A term a sqrt(pi / b) exp(-pi^2 d^2 / b) of a contrast sensitivity filter; d: degrees of visual angle. Table 1
/// of the paper.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity achromatic{1.0, 0.0047};
constexpr Sensitivity red_green{1.0, 0.0053};
constexpr Sensitivity blue_yellow[2] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double widest_b = 0.04;
constexpr double feature_width = 0.082;  // degrees between the edge detector's peak and trough

constexpr int max_radius = 1000;
constexpr double negligible = 1e-10;  // of the centre tap: such tails are cut

using Taps = std::vector<double>;

Taps gaussian(int radius, double sigma) {
    Taps taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(std::exp(-i * i / (2 * sigma * sigma)));
    return taps;
}

double sum(const Taps& taps) {
    double total = 0;
    for (const double tap : taps) total += tap;
    return total;
}

FlipKernel normalised(const Taps& taps) {
    const double total = sum(taps);
    std::size_t cut = 0;
    while (taps[cut] < negligible * taps[taps.size() / 2]) ++cut;
    FlipKernel kernel;
    for (std::size_t i = cut; i < taps.size() - cut; ++i) kernel.push_back(static_cast<float>(taps[i] / total));
    return kernel;
}

/// Positive taps to a sum of 1, negative ones to -1.
FlipKernel balanced(const Taps& taps) {
    double positive = 0, negative = 0;
    for (const double tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
    FlipKernel kernel;
    for (const double tap : taps) kernel.push_back(static_cast<float>(tap / (tap > 0 ? positive : negative)));
    return kernel;
}

/// exp(-pi^2 d^2 / b) is a Gaussian of this standard deviation, in pixels.
double sigma_of(double b, double pixels_per_degree) {
    return std::sqrt(b / (2 * pi * pi)) * pixels_per_degree;
}

}  // namespace

FlipKernels flip_kernels(double pixels_per_degree) {
    const double reach = 3 * sigma_of(widest_b, pixels_per_degree);
    if (!(pixels_per_degree >= 1 && reach <= max_radius)) {
        throw Error(fmt::format("FLIP with {} pixels per degree: 1 to {:.0f} expected", pixels_per_degree,
                                max_radius / (3 * sigma_of(widest_b, 1))));
    }
    FlipKernels k;
    const int radius = static_cast<int>(std::ceil(reach));
    k.achromatic = normalised(gaussian(radius, sigma_of(achromatic.b, pixels_per_degree)));
    k.red_green = normalised(gaussian(radius, sigma_of(red_green.b, pixels_per_degree)));
    double volume[2];
    for (int i = 0; i < 2; ++i) {
        const Taps taps = gaussian(radius, sigma_of(blue_yellow[i].b, pixels_per_degree));
        k.blue_yellow[i] = normalised(taps);
        volume[i] = blue_yellow[i].a * std::sqrt(pi / blue_yellow[i].b) * sum(taps) * sum(taps);
    }
    for (int i = 0; i < 2; ++i) k.blue_yellow_share[i] = static_cast<float>(volume[i] / (volume[0] + volume[1]));

    const double sigma = 0.5 * feature_width * pixels_per_degree;
    const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
    const Taps g = gaussian(feature_radius, sigma);
    Taps first, second;
    for (int i = -feature_radius; i <= feature_radius; ++i) {
        const double weight = g[static_cast<std::size_t>(i + feature_radius)];
        first.push_back(-i * weight);
        second.push_back((i * i / (sigma * sigma) - 1) * weight);
    }
    k.gaussian = normalised(g);
    k.edge = balanced(first);
    k.point = balanced(second);
    k.radius = std::max(radius, feature_radius);
    return k;
}

}  // namespace tyndall
