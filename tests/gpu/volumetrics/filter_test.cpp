#include <cmath>
#include <numeric>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::Filter;
using volumetrics::FilterDepth;
using Taps = std::vector<double>;  ///< by distance from the centre, px; the sum over both sides is 1

Taps normalised(Taps taps) {
    const double sum = 2 * std::accumulate(taps.begin(), taps.end(), 0.0) - taps[0];
    for (double& tap : taps) tap /= sum;
    return taps;
}

Taps gaussian(int radius, double sigma) {
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
const std::vector<Published> kernels{{Filter::box3, {1 / 3.0, 1 / 3.0}},
                                     {Filter::box5, {1 / 5.0, 1 / 5.0, 1 / 5.0}},
                                     {Filter::gaussian1, gaussian(3, 1)},
                                     {Filter::binomial3, {1 / 2.0, 1 / 4.0}},
                                     {Filter::binomial5, {6 / 16.0, 4 / 16.0, 1 / 16.0}},
                                     {Filter::gaussian15, gaussian(7, gaussian15_sigma)},
                                     {Filter::uniform9, {1 / 9.0, 1 / 9.0, 1 / 9.0, 1 / 9.0, 1 / 9.0}}};
const std::vector<FilterDepth> depth_modes{FilterDepth::none, FilterDepth::relative, FilterDepth::plane};
const std::vector<FilterDepth> by_depth{FilterDepth::relative, FilterDepth::plane};

/// What the part of a line that `takes` gives: the mean of `line` weighed by taps, renormalised over what is in it.
double filtered(const std::vector<double>& line, int at, const Taps& taps, const std::function<bool(int)>& takes) {
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
double difference(const Image& a, const Image& b) {
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
        settings.filter_sigma = gaussian15_sigma;
        settings.reconstruct = volumetrics::Reconstruct::light;
    }
    StubHost host;
    Settings settings = plain_settings(1);

    /// A fence's shadows sampled by two dithered steps: noise to be filtered.
    void dither_shadows() {
        host.ambient = glm::vec3(0);
        host.has_sun = true;
        host.sun_illuminance = glm::vec3(1000);
        host.shadows = 1;
        settings.steps = 2;
        settings.noise = volumetrics::Noise::bayer;
    }

    Frame render(Filter filter, FilterDepth depth = FilterDepth::none) {
        settings.filter = filter;
        settings.filter_depth = depth;
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

TEST_F(VolumetricsFilter, KeepsAConstantImageOfAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(48, 32), glm::ivec2(1, 1), glm::ivec2(3, 5), glm::ivec2(2, 19)})
        for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
            host.size = size;
            host.global[0].sigma_a = sigma_a;
            const Frame sharp = render(Filter::none);
            for (const Published& kernel : kernels)
                for (const FilterDepth depth : depth_modes) {
                    expect_to_rounding(render(kernel.filter, depth), sharp);
                }
        }
}

TEST_F(VolumetricsFilter, AnImpulseShowsThePublishedTaps) {
    for (const Published& kernel : kernels) {
        host.view_depth = [](int x, int y) { return x == 24 && y == 15 ? 300.0F : 0.2F; };
        const Frame sharp = render(Filter::none), frame = render(kernel.filter);
        const double low = sharp.scattering.at(0, 0)[0];
        // The picture's row 0 is at the top.
        const double height = sharp.scattering.at(24, 16)[0] - low;
        ASSERT_GT(height, 0.4);
        for (int y = -8; y <= 8; ++y)
            for (int x = -8; x <= 8; ++x) {
                const auto tap = [&](int i) {
                    return std::abs(i) > kernel.radius() ? 0 : kernel.taps[static_cast<std::size_t>(std::abs(i))];
                };
                EXPECT_NEAR((frame.scattering.at(24 + x, 16 + y)[0] - low) / height, tap(x) * tap(y),
                            1e-3 * tap(x) * tap(y) + 3e-5)
                    << static_cast<int>(kernel.filter) << ": " << x << ", " << y;
            }
    }
}

TEST_F(VolumetricsFilter, AStepIsSpreadByTheSumOfTaps) {
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    const Frame sharp = render(Filter::none);
    const double left = sharp.scattering.at(0, 16)[0], right = sharp.scattering.at(47, 16)[0];
    std::vector<double> step(48, 0.0);
    std::fill(step.begin() + 24, step.end(), 1.0);
    for (const Published& kernel : kernels) {
        const Frame frame = render(kernel.filter);
        for (int x = 0; x < 48; ++x) {
            const double part = filtered(step, x, kernel.taps, [](int) { return true; });
            EXPECT_NEAR(frame.scattering.at(x, 16)[0], left + part * (right - left), 0.002 * (right - left)) << x;
        }
    }
}

TEST_F(VolumetricsFilter, WideGaussianIsAnErrorFunction) {
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    settings.filter_sigma = 2;
    const Frame sharp = render(Filter::none), frame = render(Filter::gaussian15);
    const double left = sharp.scattering.at(0, 16)[0], right = sharp.scattering.at(47, 16)[0];
    for (int x = 14; x < 34; ++x) {
        const double part = 0.5 * (1 + std::erf((x + 0.5 - 24) / (2 * std::sqrt(2.0))));
        EXPECT_NEAR(frame.scattering.at(x, 16)[0], left + part * (right - left), 0.005 * (right - left)) << x;
    }
}

TEST_F(VolumetricsFilter, TapsOutsideOfThePictureAreLeftOut) {
    host.size = {3, 5};
    host.view_depth = [](int x, int) { return x == 0 ? 20.0F : x == 1 ? 5.0F : 1.0F; };
    const Frame sharp = render(Filter::none);
    std::vector<double> line;
    for (int x = 0; x < 3; ++x) line.push_back(sharp.scattering.at(x, 2)[0]);
    for (const Published& kernel : kernels) {
        const Frame frame = render(kernel.filter);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 3; ++x)
                EXPECT_NEAR(frame.scattering.at(x, y)[0], filtered(line, x, kernel.taps, [](int) { return true; }),
                            0.001 * line[0]);
    }
}

TEST_F(VolumetricsFilter, DepthStepsAndTheSkyAreKept) {
    host.size = {48, 48};
    host.view_depth = [](int x, int y) { return y < 24 ? (x < 24 ? 5.0F : 20.0F) : (x < 24 ? 20.0F : sky); };
    settings.filter_sigma = 3;
    for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame sharp = render(Filter::none);
        for (const Published& kernel : kernels)
            for (const FilterDepth depth : by_depth) {
                expect_to_rounding(render(kernel.filter, depth), sharp);
            }
    }
}

TEST_F(VolumetricsFilter, ASlopedSurfaceIsFilteredAndItsNoiseAway) {
    // Steps of 4% in depth from pixel to pixel are one surface; dithered shadows on it are smoothed.
    host.view_depth = [](int x, int) { return 10.0F * std::pow(1.04F, static_cast<float>(x)); };
    dither_shadows();
    settings.filter_sigma = 2;
    const auto roughness = [&](Filter filter, FilterDepth depth) {
        const Frame frame = render(filter, depth);
        double sum = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 1; x < 48; ++x)
                sum += std::pow(frame.scattering.at(x, y)[0] - frame.scattering.at(x - 1, y)[0], 2);
        return std::sqrt(sum);
    };
    const double sharp = roughness(Filter::none, FilterDepth::none);
    for (const FilterDepth depth : by_depth) EXPECT_LT(roughness(Filter::gaussian15, depth), 0.3 * sharp);
}

// A floor to the horizon, a plane that slopes in both directions, and both seen from far below and beside.
const std::vector<std::function<float(int, int)>> planes{
    [](int, int y) { return 200 / (static_cast<float>(y) + 0.5F); },
    [](int x, int) { return 200 / (static_cast<float>(x) + 0.5F); },
    [](int x, int y) { return 200 / (80 - 0.6F * static_cast<float>(x) + 2 * static_cast<float>(y)); }};

TEST_F(VolumetricsFilter, PlanesAreFilteredAsIfThereWereNoDepth) {
    settings.reconstruct = volumetrics::Reconstruct::light;
    dither_shadows();
    for (const auto& plane : planes)
        for (const Published& kernel : kernels) {
            host.view_depth = plane;
            const Frame none = render(kernel.filter);
            EXPECT_LT(difference(render(kernel.filter, FilterDepth::plane).scattering, none.scattering), 1e-3)
                << static_cast<int>(kernel.filter);
        }
}

TEST_F(VolumetricsFilter, RelativeUnderFiltersAGrazingFloorAndPlaneDoesNot) {
    dither_shadows();
    // All of it lies behind max_distance, so all pixels march the same segments: what varies is noise.
    host.view_depth = [](int, int y) { return 20000 / (static_cast<float>(y) + 0.5F); };
    const auto roughness = [&](FilterDepth depth) {
        const Frame frame = render(Filter::box5, depth);
        double sum = 0;
        for (int y = 24; y < 31; ++y)  // near the horizon; the picture's row 0 is at the top
            for (int x = 1; x < 48; ++x) {
                const double here = frame.scattering.at(x, y)[0];
                sum += std::pow(here - frame.scattering.at(x - 1, y)[0], 2) +
                       std::pow(here - frame.scattering.at(x, y + 1)[0], 2);
            }
        return std::sqrt(sum);
    };
    const double none = roughness(FilterDepth::none);
    EXPECT_GT(roughness(FilterDepth::relative), 1.5 * none);
    EXPECT_LT(roughness(FilterDepth::plane), 1.01 * none);
}

// Each side of a silhouette is filtered as a picture of it alone would be, where what is outside is left out.
TEST_F(VolumetricsFilter, SilhouettesCutTheKernelOff) {
    dither_shadows();
    const auto wall = [](int x, int) { return 1 / (1.5F + 0.002F * static_cast<float>(x)); };
    for (const Published& kernel : kernels) {
        host.size = {48, 32};
        host.view_depth = [&](int x, int y) { return x >= 24 ? wall(x, y) : y < 24 ? planes[2](x, y) : sky; };
        const Frame both = render(kernel.filter, FilterDepth::plane);
        host.size = {24, 24};
        host.view_depth = planes[2];
        const Frame floor = render(kernel.filter);
        host.size = {24, 32};
        host.view_depth = [&](int x, int y) { return wall(x + 24, y); };
        const Frame right = render(kernel.filter);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 24; ++x) {
                const double expected = right.scattering.at(x, y)[0];
                ASSERT_NEAR(both.scattering.at(x + 24, y)[0], expected, 2e-3 * expected) << x << ", " << y;
                if (y < 8) continue;
                const double below = floor.scattering.at(x, y - 8)[0];
                ASSERT_NEAR(both.scattering.at(x, y)[0], below, 2e-3 * below) << x << ", " << y;
            }
    }
}

TEST_F(VolumetricsFilter, AThinPoleIsNotSmearedAndTheWallBehindItIsOne) {
    for (const int width : {1, 2})
        for (const bool upright : {true, false}) {
            const auto is_pole = [&](int i) { return i >= 12 && i < 12 + width; };
            host.view_depth = [&](int x, int y) {
                const int i = upright ? x : 31 - y;
                return is_pole(i) ? 3.0F : 1 / (0.02F + 0.004F * static_cast<float>(i));
            };
            const Frame sharp = render(Filter::none);
            const auto at = [&](const Frame& frame, int i) {
                return double(upright ? frame.scattering.at(i, 16)[0] : frame.scattering.at(16, i)[0]);
            };
            std::vector<double> line;
            for (int i = 0; i < 32; ++i) line.push_back(at(sharp, i));
            for (const Published& kernel : kernels) {
                const Frame frame = render(kernel.filter, FilterDepth::plane);
                for (int i = 0; i < 24; ++i) {
                    const double expected =
                        filtered(line, i, kernel.taps, [&](int j) { return is_pole(i) == is_pole(j); });
                    EXPECT_NEAR(at(frame, i), expected, 2e-3 * expected) << i << ", width " << width;
                }
            }
        }
}

TEST_F(VolumetricsFilter, PlanesOfAlternatingDepthAreFilteredAndTheirEdgesKept) {
    dither_shadows();
    settings.upsample = volumetrics::Upsample::nearest;
    settings.resolution_depth = volumetrics::DepthChoice::checkerboard;
    for (const auto resolution : {volumetrics::Resolution::half, volumetrics::Resolution::quarter}) {
        settings.resolution = resolution;
        host.size = {96, 64};
        for (const auto& plane : planes) {
            host.view_depth = plane;
            const Frame none = render(Filter::box5);
            EXPECT_LT(difference(render(Filter::box5, FilterDepth::plane).scattering, none.scattering), 1e-3);
        }
        host.view_depth = [](int x, int y) { return (x + 2 * y) % 31 < 13 ? 4.0F : 20.0F; };  // faces the eye
        const Frame relative = render(Filter::uniform9, FilterDepth::relative);
        EXPECT_LT(difference(render(Filter::uniform9, FilterDepth::plane).scattering, relative.scattering), 1e-3);
    }
}

TEST_F(VolumetricsFilter, OnlyTheTapsOfTheKernelAreFetched) {
    host.count_work = true;
    for (const Published& kernel : kernels)
        for (const FilterDepth depth : depth_modes) {
            const Frame frame = render(kernel.filter, depth);
            const int textures = depth == FilterDepth::none ? 1 : 2;
            const int for_slope = depth == FilterDepth::plane ? 4 : 0;
            const int fetches = (2 * kernel.radius() + 1) * textures + for_slope;
            for (const char* pass : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
                EXPECT_EQ(frame.work.at(pass)[int(gl::Work::texture_fetches)], 48U * 32U * unsigned(fetches));
        }
}

/// The kernel after a mean of n frames: a Gaussian one of variance v becomes one of max(v, 4 px²) / n^(2/3), or of
/// 0.25 px², by a second Gaussian that multiplies all kernels; none becomes wider.
Taps narrowed(Taps taps, int n) {
    double variance = 0;
    for (std::size_t x = 1; x < taps.size(); ++x) variance += 2 * taps[x] * double(x * x);
    const double target = std::max(std::max(variance, 4.0) / std::cbrt(double(n) * n), 0.25);
    const double added = std::max(1 / target - 1 / variance, 0.0);
    for (std::size_t x = 0; x < taps.size(); ++x) taps[x] *= std::exp(-0.5 * double(x * x) * added);
    return normalised(taps);
}

TEST_F(VolumetricsFilter, NarrowsByTheFramesOfThePixelsMean) {
    host.view_depth = [](int x, int y) { return x == 24 && y == 15 ? 300.0F : 0.2F; };
    for (const Published& kernel : kernels) {
        settings.temporal = volumetrics::Temporal::off;
        const Frame sharp = render(Filter::none), plain = render(kernel.filter);
        const double low = sharp.scattering.at(0, 0)[0], height = sharp.scattering.at(24, 16)[0] - low;
        settings.temporal = volumetrics::Temporal::accumulate;
        settings.temporal_place = volumetrics::TemporalPlace::before;
        for (int n = 1; n <= 32; ++n) {
            const Frame frame = render(kernel.filter);
            if (n == 1) {
                EXPECT_EQ(frame.scattering.pixels, plain.scattering.pixels);
            }
            if (n != 1 && n != 2 && n != 8 && n != 32) continue;
            const Taps taps = narrowed(kernel.taps, n);
            for (int x = -8; x <= 8; ++x) {
                const auto i = static_cast<std::size_t>(std::abs(x));
                const double expected = i < taps.size() ? taps[i] * taps[0] : 0;
                // Taps of less than 1 / 512 of what they were may be left out.
                EXPECT_NEAR((frame.scattering.at(24 + x, 16)[0] - low) / height, expected, 2e-3 * expected + 5e-4)
                    << static_cast<int>(kernel.filter) << ", " << n << " frames: " << x;
            }
        }
    }
}

TEST_F(VolumetricsFilter, KeepsItsWidthWhereNothingCountsFramesOrItMayNot) {
    settings.filter_sigma = 3;
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    using volumetrics::Temporal;
    using volumetrics::TemporalPlace;
    const auto still = [&](Temporal temporal, TemporalPlace place, bool narrows) {
        settings.temporal = Temporal::off;
        (void)render(Filter::none);
        settings.temporal = temporal;
        settings.temporal_place = place;
        settings.filter_narrows = narrows;
        (void)render(Filter::gaussian15);
        (void)render(Filter::gaussian15);
        return render(Filter::gaussian15).scattering;
    };
    const Image plain = still(Temporal::off, TemporalPlace::before, true);
    EXPECT_GT(difference(still(Temporal::accumulate, TemporalPlace::before, true), plain), 0.01);
    EXPECT_LT(difference(still(Temporal::accumulate, TemporalPlace::before, false), plain), 1e-3);
    EXPECT_LT(difference(still(Temporal::accumulate, TemporalPlace::after, true), plain), 1e-3);
    EXPECT_LT(difference(still(Temporal::acceptance, TemporalPlace::before, true), plain), 1e-3);
}

TEST_F(VolumetricsFilter, NarrowKernelsKeepConstantsAndFetchLess) {
    host.count_work = true;
    settings.temporal = volumetrics::Temporal::accumulate;
    settings.temporal_place = volumetrics::TemporalPlace::before;
    for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame first = render(Filter::gaussian15);
        Frame frame;
        for (int n = 2; n <= 9; ++n) frame = render(Filter::gaussian15);
        EXPECT_LT(difference(frame.scattering, first.scattering), 1e-3);
        EXPECT_LT(difference(frame.transmittance, first.transmittance), 1e-3);
        for (const char* pass : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
            EXPECT_LT(frame.work.at(pass)[int(gl::Work::texture_fetches)],
                      first.work.at(pass)[int(gl::Work::texture_fetches)]);
        settings.temporal = volumetrics::Temporal::off;  // ends the history
        (void)render(Filter::none);
        settings.temporal = volumetrics::Temporal::accumulate;
    }
}

TEST_F(VolumetricsFilter, AnyDepthGivesFiniteValuesInRange) {
    std::uint32_t seed = 1;
    host.size = {47, 33};
    host.global[0].sigma_a = glm::vec3(0.01F, 0.2F, 0.8F);
    for (const float falloff : {0.0F, 3.0F, 100.0F})
        for (const Published& kernel : kernels)
            for (const FilterDepth depth : depth_modes) {
                host.view_depth = [&](int, int) {
                    seed = seed * 1664525U + 1013904223U;
                    const float r = static_cast<float>(seed >> 8) / 16777216.0F;
                    return r < 0.2F ? sky : 0.1F * std::pow(1e9F, r);
                };
                settings.filter_depth_falloff = falloff;
                const Frame frame = render(kernel.filter, depth);
                for (const float v : frame.scattering.pixels) ASSERT_TRUE(v >= 0 && v < 65504) << v;
                for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
            }
}

}  // namespace
}  // namespace tyndall::test
