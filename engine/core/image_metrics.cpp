#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace tyndall {
namespace {

/// Channels that take part: the first three, or fewer when the pictures have fewer.
int compared_channels(const Image& a, const Image& b) {
    const int channels = std::min(3, a.channels);
    if (a.size != b.size || channels != std::min(3, b.channels) || a.pixels.empty()) {
        throw Error(fmt::format("cannot compare {} x {} x {} with {} x {} x {}: equal, non-empty sizes expected",
                                a.size.x, a.size.y, a.channels, b.size.x, b.size.y, b.channels));
    }
    return channels;
}

double difference(double a, double b) {
    return a == b ? 0.0 : a - b;  // equal infinities are equal
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b, double peak) {
    const int channels = compared_channels(a, b);
    double squares = 0;
    double relative_squares = 0;
    double max = 0;
    for (int y = 0; y < a.size.y; ++y) {
        for (int x = 0; x < a.size.x; ++x) {
            for (int c = 0; c < channels; ++c) {
                const double reference = b.at(x, y)[c];
                const double d = difference(a.at(x, y)[c], reference);
                squares += d * d;
                relative_squares += d * d / (reference * reference + 0.01);
                if (std::abs(d) > max || std::isnan(d)) max = std::abs(d);
            }
        }
    }
    const double count = double(a.size.x) * a.size.y * channels;
    const double rmse = std::sqrt(squares / count);
    return {rmse, relative_squares / count,
            rmse == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(peak / rmse), max};
}

Image difference_heatmap(const Image& a, const Image& b, float white) {
    const int channels = compared_channels(a, b);
    Image map(a.size, 3);
    for (int y = 0; y < a.size.y; ++y) {
        for (int x = 0; x < a.size.x; ++x) {
            double sum = 0;
            for (int c = 0; c < channels; ++c) sum += std::abs(difference(a.at(x, y)[c], b.at(x, y)[c]));
            const double mean = sum / channels;
            const double t = mean < white ? 3 * mean / white : 3.0;  // not a number shows as white
            for (int c = 0; c < 3; ++c) map.at(x, y)[c] = float(std::clamp(t - c, 0.0, 1.0));
        }
    }
    return map;
}

}  // namespace tyndall
