#include "engine/core/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>

#include "engine/core/error.h"
#include "engine/core/flip_strip.h"
#include "engine/core/image_metrics.h"
#include "engine/core/srgb.h"

namespace tyndall {
namespace {

// Andersson et al. 2020, sections 4.1.3 and 4.3.
constexpr float color_exponent = 0.7f;    // q_c
constexpr float feature_exponent = 0.5f;  // q_f
constexpr float knee_at = 0.4f;           // p_c: this share of the largest colour error ...
constexpr float knee_error = 0.95f;       // p_t: ... becomes this error

constexpr int strip_rows = 64;

float largest_color_error() {
    static const float value =
        std::pow(hyab(hunt_lab(relative_xyz({0, 1, 0})), hunt_lab(relative_xyz({0, 0, 1}))), color_exponent);
    return value;
}

float error_of(const FlipPercept& a, const FlipPercept& b, float largest) {
    const float color = std::pow(hyab(a.color, b.color), color_exponent);
    const float knee = knee_at * largest;
    const float color_error = color < knee ? knee_error * color / knee
                                           : knee_error + (1 - knee_error) * (color - knee) / (largest - knee);
    const float feature = std::max(std::abs(a.edge - b.edge), std::abs(a.point - b.point));
    const float feature_error = std::pow(feature * std::sqrt(0.5f), feature_exponent);
    return std::clamp(std::pow(color_error, 1 - feature_error), 0.0f, 1.0f);
}

/// Linear 0..1 values of a stored one.
using ToLinear = float (*)(float stored, float scale);

float from_srgb(float stored, float) {
    return srgb_decode(std::clamp(stored, 0.0f, 1.0f));
}

// The ACES curve (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5) of Narkowicz 2015 at 0.6 times the exposure.
constexpr float aces_k0 = 0.6f * 0.6f * 2.51f;
constexpr float aces_k1 = 0.6f * 0.03f;
constexpr float aces_k3 = 0.6f * 0.6f * 2.43f;
constexpr float aces_k4 = 0.6f * 0.59f;
constexpr float aces_k5 = 0.14f;

float tonemapped(float stored, float scale) {
    const float x = std::clamp(stored * scale, 0.0f, 1e6f);  // white is below 10
    return std::min((aces_k0 * x + aces_k1) * x / ((aces_k3 * x + aces_k4) * x + aces_k5), 1.0f);
}

/// Raises the rows [begin, end) of `error` to the error at one exposure.
struct StripTask {
    const Image& test;
    const Image& reference;
    const FlipKernels& kernels;
    ToLinear to_linear;
    const std::vector<float>& scales;  ///< exposures
    Image& error;

    void run(FlipStrip& strip, int begin, int end) const {
        std::vector<FlipPercept> a, b;
        const float largest = largest_color_error();
        for (const float scale : scales) {
            strip.perceive(rows_of(test, scale), begin, end, a);
            strip.perceive(rows_of(reference, scale), begin, end, b);
            float* out = error.at(0, begin);
            for (std::size_t i = 0; i < a.size(); ++i) out[i] = std::max(out[i], error_of(a[i], b[i], largest));
        }
    }
    [[nodiscard]] FlipRows rows_of(const Image& image, float scale) const {
        return [&image, scale, convert = to_linear](int y, float* red, float* green, float* blue) {
            const float* in = image.at(0, y);
            for (int x = 0; x < image.size.x; ++x, in += image.channels) {
                red[x] = convert(in[0], scale);
                green[x] = convert(in[1], scale);
                blue[x] = convert(in[2], scale);
            }
        };
    }
};

Image largest_error(const Image& test, const Image& reference, ToLinear to_linear, const std::vector<float>& scales,
                    double pixels_per_degree) {
    if (test.size != reference.size || test.channels < 3 || reference.channels < 3 || test.pixels.empty()) {
        throw Error(fmt::format(
            "FLIP of {} x {} x {} against {} x {} x {}: equal, non-empty sizes of at least three "
            "channels expected",
            test.size.x, test.size.y, test.channels, reference.size.x, reference.size.y, reference.channels));
    }
    require_finite(test, "test picture");
    require_finite(reference, "reference");
    const FlipKernels kernels = flip_kernels(pixels_per_degree);
    Image error(test.size, 1);
    const StripTask task{test, reference, kernels, to_linear, scales, error};
    const int strips = (test.size.y + strip_rows - 1) / strip_rows;
    std::atomic<int> next = 0;
    const auto work = [&] {
        FlipStrip strip(kernels, test.size.x, test.size.y);
        for (int i = next++; i < strips; i = next++)
            task.run(strip, i * strip_rows, std::min((i + 1) * strip_rows, test.size.y));
    };
    const int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, strips);
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
    others.clear();
    return error;
}

float luminance(const float* rgb) {
    return std::max(0.0f, 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]);
}

/// The mean of the middle two of an even number. Reorders.
double median(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (double{*middle} + *std::max_element(values.begin(), middle));
}

}  // namespace

Image flip_error(const Image& test, const Image& reference, double pixels_per_degree) {
    return largest_error(test, reference, from_srgb, {1.0f}, pixels_per_degree);
}

Image hdr_flip_error(const Image& test, const Image& reference, double pixels_per_degree) {
    const FlipExposures exposures = flip_exposures(reference);
    std::vector<float> scales;
    for (int i = 0; i < exposures.count; ++i) {
        const double t = static_cast<double>(i) / (exposures.count - 1);
        scales.push_back(static_cast<float>(std::exp2(std::lerp(exposures.start, exposures.stop, t))));
    }
    return largest_error(test, reference, tonemapped, scales, pixels_per_degree);
}

FlipExposures flip_exposures(const Image& reference) {
    if (reference.channels < 3 || reference.pixels.empty())
        throw Error("FLIP: a reference of at least three channels expected");
    require_finite(reference, "reference");
    std::vector<float> values;
    for (std::size_t i = 0; i < reference.pixels.size(); i += static_cast<std::size_t>(reference.channels))
        values.push_back(luminance(&reference.pixels[i]));
    const double brightest = *std::ranges::max_element(values);
    if (brightest <= 0) return {};
    double middle = median(values);
    if (middle <= 0) {
        std::erase(values, 0.0f);
        middle = median(values);
    }
    // The x > 0 that the curve maps to 0.85: a x^2 + b x + c = 0.
    constexpr double t = 0.85;
    constexpr double a = aces_k0 - t * aces_k3, b = aces_k1 - t * aces_k4, c = -t * aces_k5;
    const double x = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    FlipExposures result{std::log2(x / brightest), std::log2(x / middle), 2};
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
    return result;
}

Image flip_heatmap(const Image& error) {
    // matplotlib's magma (van der Walt and Smith, CC0) at tenths.
    constexpr std::array<std::array<int, 3>, 11> magma{{{0, 0, 4},
                                                        {20, 14, 54},
                                                        {59, 15, 112},
                                                        {100, 26, 128},
                                                        {140, 41, 129},
                                                        {183, 55, 121},
                                                        {222, 73, 104},
                                                        {247, 112, 92},
                                                        {254, 159, 109},
                                                        {254, 207, 146},
                                                        {252, 253, 191}}};
    Image map(error.size, 3);
    for (int y = 0; y < map.size.y; ++y) {
        for (int x = 0; x < map.size.x; ++x) {
            const float t = 10 * std::clamp(error.at(x, y)[0], 0.0f, 1.0f);
            const auto i = std::min(static_cast<std::size_t>(t), magma.size() - 2);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto low = static_cast<float>(magma[i][c]), high = static_cast<float>(magma[i + 1][c]);
                map.at(x, y)[c] = std::lerp(low, high, t - static_cast<float>(i)) / 255;
            }
        }
    }
    return map;
}

}  // namespace tyndall
