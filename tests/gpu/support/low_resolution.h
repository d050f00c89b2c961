#pragma once
// A technique at lower resolution: sizes of which blocks are cut, and how far two pictures differ.

#include <algorithm>
#include <array>

#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {

inline constexpr std::array low_resolution_sizes{glm::ivec2(1), glm::ivec2(3, 5), glm::ivec2(32, 16),
                                                 glm::ivec2(33, 19)};

/// Largest difference of the first channel over the mean of `b`.
inline double largest_difference(const Image& a, const Image& b) {
    double largest = 0, mean = 0;
    const int count = b.size.x * b.size.y;
    for (int i = 0; i < count; ++i) {
        const double value = b.pixels[static_cast<std::size_t>(i * b.channels)];
        largest = std::max(largest, std::abs(a.pixels[static_cast<std::size_t>(i * a.channels)] - value));
        mean += value / count;
    }
    return largest / mean;
}

/// What a person can choose to happen to samples: noise, filter, history and a quarter of the resolution.
inline void reconstruct_all(Settings& s) {
    s.noise.kind = volumetrics::Noise::white;
    s.noise.time = volumetrics::NoiseTime::own;
    s.filter.kernel = volumetrics::Filter::gaussian15;
    s.temporal.mode = volumetrics::Temporal::accumulate;
    s.resolution.size = volumetrics::Resolution::quarter;
}

}  // namespace tyndall::test
