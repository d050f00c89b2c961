#pragma once
// What the tests of the setting filter share: the published kernels, and a host whose rays are all alike.

#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {

using volumetrics::Filter;
using volumetrics::FilterDepth;
using Taps = std::vector<double>;  ///< by distance from the centre, px; the sum over both sides is 1

inline Taps normalised(Taps taps) {
    const double sum = 2 * std::accumulate(taps.begin(), taps.end(), 0.0) - taps[0];
    for (double& tap : taps) tap /= sum;
    return taps;
}

inline Taps gaussian(int radius, double sigma) {
    Taps taps;
    for (int x = 0; x <= radius; ++x) taps.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
    return normalised(taps);
}

constexpr float gaussian15_sigma = 1.5F;

struct Published {
    Filter filter;
    Taps taps;
    [[nodiscard]] int radius() const { return static_cast<int>(taps.size()) - 1; }
};
inline const std::vector<Published> kernels{{Filter::box3, {1 / 3.0, 1 / 3.0}},
                                            {Filter::box5, {1 / 5.0, 1 / 5.0, 1 / 5.0}},
                                            {Filter::gaussian1, gaussian(3, 1)},
                                            {Filter::binomial3, {1 / 2.0, 1 / 4.0}},
                                            {Filter::binomial5, {6 / 16.0, 4 / 16.0, 1 / 16.0}},
                                            {Filter::gaussian15, gaussian(7, gaussian15_sigma)},
                                            {Filter::uniform9, {1 / 9.0, 1 / 9.0, 1 / 9.0, 1 / 9.0, 1 / 9.0}}};
inline const std::vector<FilterDepth> depth_modes{FilterDepth::none, FilterDepth::relative, FilterDepth::plane};

/// What the part of a line that `takes` gives: the mean of `line` weighed by taps, renormalised over what is in it.
inline double filtered(const std::vector<double>& line, int at, const Taps& taps,
                       const std::function<bool(int)>& takes) {
    double sum = 0, total = 0;
    for (int i = 0; i < static_cast<int>(line.size()); ++i) {
        const auto distance = static_cast<std::size_t>(std::abs(i - at));
        if (distance >= taps.size() || !takes(i)) continue;
        sum += taps[distance] * line[static_cast<std::size_t>(i)];
        total += taps[distance];
    }
    return sum / total;
}

/// Largest difference of two pictures relative to the largest value.
inline double difference(const Image& a, const Image& b) {
    double most = 0, scale = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        most = std::max(most, std::abs(double(a.pixels[i]) - b.pixels[i]));
        scale = std::max(scale, std::abs(double(b.pixels[i])));
    }
    return most / scale;
}

class VolumetricsFilter : public GlTest {
  protected:
    VolumetricsFilter() {
        host.size = {48, 32};
        host.vertical_fov = 1e-4F;  // all rays alike
        host.ambient = glm::vec3(1);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.05F)}};
        settings.filter.sigma = gaussian15_sigma;
        settings.filter.reconstruct = volumetrics::Reconstruct::light;
    }
    StubHost host;
    Settings settings = plain_settings(1);

    /// A fence's shadows sampled by two dithered steps: noise to be filtered.
    void dither_shadows() {
        host.ambient = glm::vec3(0);
        host.has_sun = true;
        host.sun_illuminance = glm::vec3(1000);
        host.shadows = 1;
        settings.march.steps = 2;
        settings.noise.kind = volumetrics::Noise::bayer;
    }

    Frame render(Filter filter, FilterDepth depth = FilterDepth::none) {
        settings.filter.kernel = filter;
        settings.filter.depth = depth;
        return host.render(settings);
    }
    /// To half a step of half floats.
    static void expect_to_rounding(const Frame& frame, const Frame& expected) {
        for (std::size_t i = 0; i < expected.scattering.pixels.size(); ++i)
            ASSERT_NEAR(frame.scattering.pixels[i], expected.scattering.pixels[i],
                        expected.scattering.pixels[i] / 2048);
        for (std::size_t i = 0; i < expected.transmittance.pixels.size(); ++i)
            ASSERT_NEAR(frame.transmittance.pixels[i], expected.transmittance.pixels[i],
                        expected.transmittance.pixels[i] / 2048 + 6e-8F);
    }
};

}  // namespace tyndall::test
