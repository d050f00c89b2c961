#include "around.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "draw_scene.h"
#include "moderate.h"

namespace tyndall::stress {
namespace {

int filter_radius(volumetrics::Filter filter) {
    constexpr int radii[] = {0, 1, 2, 3, 1, 2, 7, 4};
    return radii[static_cast<int>(filter)];
}

int radius_of(const StressFrame& frame) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    switch (frame.feature) {
        case Feature::plain:
            break;
        case Feature::filter:
            return filter_radius(v.filter.kernel);
        case Feature::history:  // temporal_clip: 3 x 3 pixels
            return 1;
        case Feature::low_resolution:
            return v.resolution.size == volumetrics::Resolution::half ? 4 : 8;
    }
    return 0;
}

/// How far depths within a block's reach of a pixel lie apart, relative to its own; over a silhouette 0: pixels
/// around see the one and the other. Before the sky: none, for a ray through the middle of a block that looks as
/// far as a pixel of it may see what no pixel sees.
std::optional<double> depth_spread(const Around& range, int x, int y) {
    constexpr double silhouette = 0.1;
    const glm::ivec2 last = range.depth.size - 1;
    float least = range.depth.at(x, y)[0], most = least;
    for (int j = std::max(y - range.block + 1, 0); j <= std::min(y + range.block - 1, last.y); ++j)
        for (int i = std::max(x - range.block + 1, 0); i <= std::min(x + range.block - 1, last.x); ++i) {
            least = std::min(least, range.depth.at(i, j)[0]);
            most = std::max(most, range.depth.at(i, j)[0]);
        }
    if (least == 0 && most > 0) return {};
    const double spread = least > 0 ? double(most) / least - 1 : 0;
    return spread < silhouette ? spread : 0;
}

Image mean_of(const std::vector<Layers>& frames, Image Layers::*layer) {
    Image mean = frames.front().*layer;
    for (std::size_t i = 1; i < frames.size(); ++i)
        for (std::size_t k = 0; k < mean.pixels.size(); ++k) mean.pixels[k] += (frames[i].*layer).pixels[k];
    for (float& v : mean.pixels) v /= static_cast<float>(frames.size());
    return mean;
}

}  // namespace

bool counts_all_frames(const StressFrame& frame) {
    const volumetrics::Settings& v = frame.options.volumetrics;
    return frame.feature == Feature::history && !holds_froxels(frame.options.volumetrics.technique) &&
           v.temporal.mode == volumetrics::Temporal::accumulate && v.temporal.frames >= history_frames &&
           !v.temporal.clip && !v.temporal.reject;
}

Around around(const StressFrame& frame, const std::vector<Layers>& plain, Image Layers::*layer) {
    if (counts_all_frames(frame)) {
        // A history rounds each of its means by up to 1e-3, up as often as down.
        const Image mean = mean_of(plain, layer);
        return {.relative = 3e-3, .floor = 1e-5, .least = mean, .most = mean};
    }
    const Image& first = plain.front().*layer;
    // A low pixel looks through the middle of its block; of local media each ray has noise of its own.
    // Transmittance changes by more of itself, the less there is of it.
    const double floor = layer == &Layers::transmittance ? 1e-3 : 1e-5;
    const std::string& technique = frame.options.volumetrics.technique;
    const bool lines = technique == "epipolar" || technique == "auto";  // others at another resolution
    const double block = std::ranges::any_of(frame.media, is_bounded) ? 0.1 : lines ? 0.05 : 0.02;
    Around range{.radius = radius_of(frame),
                 .relative = frame.feature == Feature::low_resolution ? block : 2e-3,
                 .floor = floor,
                 .blocks = frame.feature == Feature::low_resolution,
                 .least = first,
                 .most = first};
    if (range.blocks) {
        // Columns let light through silhouettes, the less of it the finer they are.
        if (layer == &Layers::scattering && holds_froxels(technique)) range.floor = 5e-4;
        range.depth = plain.front().depth;
        range.block = frame.options.volumetrics.resolution.size == volumetrics::Resolution::half ? 2 : 4;
    }
    for (const Layers& layers : plain)
        for (std::size_t k = 0; k < first.pixels.size(); ++k) {
            range.least.pixels[k] = std::min(range.least.pixels[k], (layers.*layer).pixels[k]);
            range.most.pixels[k] = std::max(range.most.pixels[k], (layers.*layer).pixels[k]);
        }
    return range;
}

double compare_around(const Around& range, const Image& value, std::string& where) {
    double worst = 0;
    for (int y = 0; y < value.size.y; ++y)
        for (int x = 0; x < value.size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                float least = range.least.at(x, y)[c], most = range.most.at(x, y)[c];
                for (int j = std::max(y - range.radius, 0); j <= std::min(y + range.radius, value.size.y - 1); ++j)
                    for (int i = std::max(x - range.radius, 0); i <= std::min(x + range.radius, value.size.x - 1);
                         ++i) {
                        least = std::min(least, range.least.at(i, j)[c]);
                        most = std::max(most, range.most.at(i, j)[c]);
                    }
                const int to_border = std::min({x, y, value.size.x - 1 - x, value.size.y - 1 - y});
                if (range.blocks && to_border < range.radius) {  // a block's middle may lie outside
                    const float beyond = 0.25f * static_cast<float>(range.block) * (most - least);
                    least -= beyond;
                    most += beyond;
                }
                // A ray that ends before or behind its own surface gathers about as much less or more.
                const std::optional<double> apart = range.blocks ? depth_spread(range, x, y) : 0;
                if (!apart) continue;
                const double v = value.at(x, y)[c],
                             slack = (range.relative + *apart) * static_cast<double>(most) + range.floor;
                const double excess = std::max(v - most, least - v) / slack;
                if (excess <= worst) continue;
                worst = std::isnan(excess) ? std::numeric_limits<double>::infinity() : excess;
                where = fmt::format("pixel ({}, {}) channel {} is {}, the plain ones around {} to {}", x, y, c, v,
                                    least, most);
            }
    return worst;
}

}  // namespace tyndall::stress
