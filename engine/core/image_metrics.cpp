#include "engine/core/image_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/srgb.h"

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

/// Calls visit(value) of the first three channels.
template <typename Visit>
void for_each_value(const Image& image, Visit visit) {
    const int channels = std::min(3, image.channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
        for (int c = 0; c < channels; ++c) visit(image.pixels[i + static_cast<std::size_t>(c)]);
}

double mean_difference(const Image& a, const Image& b) {
    compared_channels(a, b);
    return mean_value(a) - mean_value(b);
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

void require_finite(const Image& image, const std::string& name) {
    const int channels = std::min(3, image.channels);
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            for (int c = 0; c < channels; ++c)
                if (!std::isfinite(image.at(x, y)[c])) {
                    throw Error(fmt::format("{}: {} in channel {} of pixel ({}, {}): finite values expected", name,
                                            image.at(x, y)[c], c, x, y));
                }
}

double mean_value(const Image& image) {
    double sum = 0;
    std::size_t count = 0;
    for_each_value(image, [&](float v) {
        sum += v;
        ++count;
    });
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

double relative_rmse(const Image& a, const Image& reference) {
    const double rmse = compare_images(a, reference).rmse;
    return rmse == 0 ? 0.0 : rmse / mean_value(reference);
}

Image threshold_picture(const Image& a, const Image& reference, float threshold) {
    const int channels = compared_channels(a, reference);
    Image picture(a.size, 3);
    for (int y = 0; y < a.size.y; ++y) {
        for (int x = 0; x < a.size.x; ++x) {
            const float* test = a.at(x, y);
            const float* truth = reference.at(x, y);
            float* out = picture.at(x, y);
            bool differs = false;
            for (int c = 0; c < channels; ++c) differs |= !(std::abs(test[c] - truth[c]) <= threshold);
            for (int c = 0; c < 3; ++c) out[c] = 0.5f * std::clamp(truth[std::min(c, channels - 1)], 0.0f, 1.0f);
            if (differs) {
                out[0] = 1;
                out[1] = out[2] = 0;
            }
        }
    }
    return picture;
}

Image radiance_to_display(const Image& radiance, float white) {
    Image display(radiance.size, 3);
    const int channels = std::min(3, radiance.channels);
    for (int y = 0; y < display.size.y; ++y)
        for (int x = 0; x < display.size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const float linear = radiance.at(x, y)[std::min(c, channels - 1)] / white;
                display.at(x, y)[c] = srgb_encode(std::clamp(linear, 0.0f, 1.0f));
            }
    return display;
}

float display_white(const Image& radiance) {
    std::vector<float> values;
    values.reserve(radiance.pixels.size());
    for_each_value(radiance, [&](float v) { values.push_back(v); });
    if (values.empty()) return 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() * 99 + 99) / 100 - 1);
    std::nth_element(values.begin(), at, values.end());
    if (*at > 0) return *at;
    const float peak = *std::max_element(at, values.end());
    return peak > 0 ? peak : 1.0f;
}

double flicker(std::span<const Image> frames) {
    if (frames.size() < 2) throw Error(fmt::format("flicker of {} frames: at least two expected", frames.size()));
    double change = 0;
    double brightness = mean_value(frames[0]);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const int channels = compared_channels(frames[i], frames[i - 1]);
        double sum = 0;
        for (int y = 0; y < frames[i].size.y; ++y)
            for (int x = 0; x < frames[i].size.x; ++x)
                for (int c = 0; c < channels; ++c)
                    sum += std::abs(difference(frames[i].at(x, y)[c], frames[i - 1].at(x, y)[c]));
        change += sum / (double(frames[i].size.x) * frames[i].size.y * channels);
        brightness += mean_value(frames[i]);
    }
    if (change == 0) return 0;
    const double count = static_cast<double>(frames.size());
    return (change / (count - 1)) / (brightness / count);
}

double residual_light(const Image& frame, const Image& on, const Image& off) {
    const double whole = mean_difference(on, off);
    if (whole == 0) throw Error("residual light: the frames with and without the light are equally bright");
    return mean_difference(frame, off) / whole;
}

}  // namespace tyndall
