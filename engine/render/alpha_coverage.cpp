#include "engine/render/alpha_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

using Histogram = std::array<std::size_t, 256>;

Histogram alpha_histogram(std::span<const std::uint8_t> rgba) {
    Histogram counts{};
    for (std::size_t i = 3; i < rgba.size(); i += 4) ++counts[rgba[i]];
    return counts;
}

/// Smallest 8-bit alpha that passes; 256 where none does.
int threshold(float cutoff) {
    return std::clamp(static_cast<int>(std::ceil(cutoff * 255.0f - 1e-3f)), 0, 256);
}

}  // namespace

float alpha_coverage(std::span<const std::uint8_t> rgba, float cutoff) {
    const Histogram counts = alpha_histogram(rgba);
    std::size_t passing = 0;
    for (int alpha = threshold(cutoff); alpha < 256; ++alpha) passing += counts[static_cast<std::size_t>(alpha)];
    return rgba.empty() ? 0.0f : static_cast<float>(passing) / static_cast<float>(rgba.size() / 4);
}

void scale_alpha_to_coverage(std::span<std::uint8_t> rgba, float cutoff, float coverage) {
    // Of the alphas a texel may have, the one whose share of texels at or above it is nearest to `coverage` is
    // moved to the threshold.
    const Histogram counts = alpha_histogram(rgba);
    const float wanted = coverage * static_cast<float>(rgba.size() / 4);
    const int pass = threshold(cutoff);
    std::size_t above = 0;
    int best = pass;
    float best_error = HUGE_VALF;
    for (int alpha = 255; alpha > 0; --alpha) {
        above += counts[static_cast<std::size_t>(alpha)];
        const float error = std::abs(static_cast<float>(above) - wanted);
        const bool nearer = error < best_error;
        const bool milder = error == best_error && std::abs(alpha - pass) < std::abs(best - pass);
        if (nearer || milder) best = alpha, best_error = error;
    }
    const float factor = static_cast<float>(pass) / static_cast<float>(best);
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        rgba[i] = static_cast<std::uint8_t>(std::min(std::round(static_cast<float>(rgba[i]) * factor), 255.0f));
}

}  // namespace tyndall
