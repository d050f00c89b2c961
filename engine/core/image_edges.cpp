#include "engine/core/image_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/core/error.h"

namespace tyndall {
namespace {

constexpr float threshold = 0.1f;

/// Linear over a plane on screen; 0 for the sky. Outside it is that of the border.
float inverse_depth(const Image& depth, glm::ivec2 p) {
    p = glm::clamp(p, glm::ivec2(0), depth.size - 1);
    const float d = *depth.at(p.x, p.y);
    return d > 0 ? 1 / d : 0;
}

/// Between a pixel and the next in a direction.
bool is_edge(const Image& depth, glm::ivec2 p, glm::ivec2 step) {
    const float here = inverse_depth(depth, p), there = inverse_depth(depth, p + step);
    const float from_here = 2 * here - inverse_depth(depth, p - step);
    const float from_there = 2 * there - inverse_depth(depth, p + 2 * step);
    return std::min(std::abs(there - from_here), std::abs(here - from_there)) > threshold * std::max(here, there);
}

void mark(Image& band, glm::ivec2 p, int radius) {
    const glm::ivec2 low = glm::max(p - radius, glm::ivec2(0)), high = glm::min(p + radius, band.size - 1);
    for (int y = low.y; y <= high.y; ++y) std::fill(band.at(low.x, y), band.at(high.x, y) + 1, 1.0f);
}

}  // namespace

Image edge_band(const Image& depth, int radius) {
    if (depth.channels != 1)
        throw Error(fmt::format("edges of a picture with {} channels: depth has one", depth.channels));
    Image band(depth.size, 1);
    for (int y = 0; y < depth.size.y; ++y)
        for (int x = 0; x < depth.size.x; ++x)
            for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
                const glm::ivec2 p(x, y), next = p + step;
                if (next.x >= depth.size.x || next.y >= depth.size.y || !is_edge(depth, p, step)) continue;
                mark(band, p, radius - 1);
                mark(band, next, radius - 1);
            }
    return band;
}

MaskedError masked_relative_rmse(const Image& a, const Image& reference, const Image& mask) {
    const int channels = std::min({3, a.channels, reference.channels});
    if (a.size != reference.size || a.size != mask.size || a.pixels.empty())
        throw Error(fmt::format("cannot compare {} x {} with {} x {} at the edges of {} x {}: equal sizes expected",
                                a.size.x, a.size.y, reference.size.x, reference.size.y, mask.size.x, mask.size.y));
    double squares[2] = {}, sums[2] = {}, counts[2] = {};
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            const int part = *mask.at(x, y) > 0 ? 0 : 1;
            counts[part] += 1;
            for (int c = 0; c < channels; ++c) {
                const double expected = reference.at(x, y)[c];
                squares[part] += std::pow(a.at(x, y)[c] - expected, 2);
                sums[part] += expected;
            }
        }
    const auto error = [&](int part) {
        const double values = counts[part] * channels;
        return squares[part] > 0 ? std::sqrt(squares[part] / values) / (sums[part] / values) : 0.0;
    };
    return {error(0), error(1), counts[0] / (counts[0] + counts[1])};
}

}  // namespace tyndall
