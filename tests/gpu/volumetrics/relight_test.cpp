// The setting reconstruct = visibility, judged by the technique reference.

#include <cmath>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::Filter;
using volumetrics::Reconstruct;

class VolumetricsRelight : public GlTest {
  protected:
    VolumetricsRelight() {
        host.size = {24, 16};
        host.vertical_fov = 0.8F;
        host.global = {{.sigma_s = glm::vec3(0.02F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.3F}};
    }
    StubHost host;

    /// Dithered and filtered, whatever the depth.
    static Settings filtered(Reconstruct reconstruct) {
        Settings settings = plain_settings(4);
        settings.noise.kind = volumetrics::Noise::bayer;
        settings.filter.kernel = Filter::gaussian15;
        settings.filter.sigma = 2;
        settings.filter.depth = volumetrics::FilterDepth::none;
        settings.filter.reconstruct = reconstruct;
        return settings;
    }
    void light_everything() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.4F));
        host.sun_illuminance = {100, 80, 30};
        host.ambient = {0.2F, 0.3F, 0.5F};
        host.lights = {point_light({0.3F, 0.2F, -4}, 20), point_light({-1, 0.5F, -6}, 30, 3)};
        host.lights[1].intensity_radius = {5, 20, 0, 0.01F};
    }
    /// The same media and lights by the technique reference, attenuated as `like` says.
    Frame truth(const Settings& like = {}) {
        Settings settings = like;
        settings.technique = "reference";
        return host.render(settings);
    }
    /// Largest difference of two pictures, relative to the value (and to `least`).
    static double largest(const Image& a, const Image& b, float least = 1e-4F) {
        double worst = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            const double difference = std::abs(a.pixels[i] - b.pixels[i]) / std::max(std::abs(b.pixels[i]), least);
            worst = std::isfinite(difference) ? std::max(worst, difference) : INFINITY;
        }
        return worst;
    }
    static double squared_error(const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(a.pixels[i] - b.pixels[i], 2);
        return sum;
    }
};

// Three half-float roundings: 3 / 2048.
constexpr double rounding = 2e-3;

TEST_F(VolumetricsRelight, LitSceneIsExactInSpiteOfTheFilter) {
    light_everything();
    host.view_depth = [](int x, int y) { return x < 10 ? 6.0F : y < 6 ? sky : 15.0F; };
    for (const glm::vec3 sigma_a : {glm::vec3(0.01F), glm::vec3(0, 0.02F, 0.1F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame expected = truth();
        const Frame frame = host.render(filtered(Reconstruct::visibility));
        EXPECT_LE(largest(frame.scattering, expected.scattering), rounding);
        EXPECT_LE(largest(frame.transmittance, expected.transmittance), 1e-3);
        // The glow of the lamps is what the filter takes away elsewhere.
        EXPECT_GT(largest(host.render(filtered(Reconstruct::light)).scattering, expected.scattering), 0.1);
    }
}

TEST_F(VolumetricsRelight, EachLightAloneIsExactToo) {
    for (const bool sun : {true, false}) {
        light_everything();
        host.has_sun = sun;
        if (sun) host.lights.clear();
        // The closed form of lamps in 4 segments is 0.4% off.
        EXPECT_LE(largest(host.render(filtered(Reconstruct::visibility)).scattering, truth().scattering),
                  sun ? rounding : 5e-3);
    }
}

TEST_F(VolumetricsRelight, WhatIsInShadowScattersAmbientLightOnly) {
    light_everything();
    host.lights = {point_light({-2, 0, -3}, 20)};
    host.shadows =
        2;  // the half x < 0 of z = -6, seen from the lamp at x = -2: all before it is lit, all behind dark
    host.eye = {-2, 0, -7};
    host.view_depth = [](int, int) { return 3.0F; };
    host.vertical_fov = 0.2F;
    host.has_sun = false;
    const Frame frame = host.render(filtered(Reconstruct::visibility));
    EXPECT_LE(largest(frame.scattering, truth().scattering), rounding);
    host.lights.clear();
    EXPECT_LE(largest(frame.scattering, truth().scattering), rounding);
}

TEST_F(VolumetricsRelight, ShadowEdgesHaveNoMoreErrorThanFilteredLight) {
    light_everything();
    host.ambient = glm::vec3(0);
    for (const int shadows : {1, 2, 3}) {
        host.shadows = shadows;
        const Image expected = truth().scattering;
        const double light = squared_error(host.render(filtered(Reconstruct::light)).scattering, expected);
        const double visibility =
            squared_error(host.render(filtered(Reconstruct::visibility)).scattering, expected);
        EXPECT_LT(visibility, light) << "shadows " << shadows;
    }
}

TEST_F(VolumetricsRelight, PixelsWithoutLightDoNotDimTheirNeighbours) {
    // A spot whose cone ends inside the picture: outside of it there is no light and no visibility.
    host.lights = {spot_light({0, 2, -5}, {0, -1, 0}, 50, 0.95F, 0.9F)};
    const Image expected = truth().scattering;
    const Image image = host.render(filtered(Reconstruct::visibility)).scattering;
    int dark = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) {
            dark += expected.at(x, y)[0] == 0;
            // The closed form of the cone's edge in 4 segments is up to 1.6% off.
            EXPECT_NEAR(image.at(x, y)[0], expected.at(x, y)[0], 0.02 * expected.at(x, y)[0] + 1e-5)
                << x << ' ' << y;
        }
    EXPECT_GT(dark, 25);
}

TEST_F(VolumetricsRelight, ExtremesStayFiniteAndInRange) {
    for (const float intensity : {0.0F, 1e-6F, 1e8F}) {
        for (const float sigma : {1e-6F, 1e4F}) {
            light_everything();
            host.shadows = 1;
            host.sun_illuminance = {intensity, 0, 0};
            host.lights = {point_light({0, 0, 0}, intensity, 1000, 0), point_light({0.1F, 0, -2}, intensity)};
            host.lights[0].intensity_radius.y = 0;
            host.global = {{.sigma_s = {sigma, 0, 2 * sigma}, .sigma_a = {0, sigma, 0}, .anisotropy = 0.999F}};
            const Frame frame = host.render(filtered(Reconstruct::visibility));
            for (const float v : frame.scattering.pixels)
                ASSERT_TRUE(v >= 0 && v <= 65504) << intensity << ' ' << v;
            for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
        }
    }
}

TEST_F(VolumetricsRelight, LocalMediaAreSampledSliceBySlice) {
    // A box of fog in fog, all lit: the filter leaves less error than of the light.
    light_everything();
    host.local.resize(1);
    host.local[0].shape = Shape::box;
    host.local[0].center = {1, 0, -8};
    host.local[0].half_extent = {2, 1, 2};
    host.local[0].sigma_s = glm::vec3(0.3F);
    host.view_depth = [](int, int) { return 20.0F; };
    const Image expected = truth().scattering;
    const double light = squared_error(host.render(filtered(Reconstruct::light)).scattering, expected);
    const double visibility = squared_error(host.render(filtered(Reconstruct::visibility)).scattering, expected);
    EXPECT_LT(visibility, light);
}

// Media in a row, which the march reads run by run of froxel slices.
class VolumetricsParts : public VolumetricsRelight {
  protected:
    VolumetricsParts() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.4F));
        host.sun_illuminance = {100, 80, 30};
        host.ambient = {0.2F, 0.3F, 0.5F};
        host.view_depth = [](int, int) { return 20.0F; };
    }
    static LocalMedium box(glm::vec3 center, glm::vec3 half_extent, float sigma) {
        return {.shape = Shape::box,
                .center = center,
                .half_extent = half_extent,
                .sigma_s = glm::vec3(0.8F * sigma),
                .sigma_a = glm::vec3(0.2F * sigma)};
    }
    static Settings coarse(int steps) {
        Settings settings = filtered(Reconstruct::visibility);
        settings.march.steps = steps;
        settings.froxels.distribution = volumetrics::DepthDistribution::linear;
        settings.froxels.far = 40;
        return settings;
    }
    /// Medium samples a pixel.
    double samples(const Settings& settings) {
        host.count_work = true;
        const auto work = host.render(settings).work.at("volumetrics/march");
        return double(work[int(gl::Work::medium_samples)]) / (host.size.x * host.size.y);
    }
};

TEST_F(VolumetricsParts, MediumThatFillsAllIsTheClosedFormInAnyNumberOfSteps) {
    host.local = {box(glm::vec3(0), glm::vec3(1000), 0.05F)};
    host.local[0].anisotropy = 0.3F;
    for (const int steps : {1, 3, 8}) {
        Settings settings = coarse(steps);
        settings.light.transmittance = false;
        const Frame frame = host.render(settings);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 24; ++x) {
                const glm::vec3 ray = host.ray(x, 15 - y);
                const double transmittance = std::exp(-0.08 * 20 / -ray.z);
                const double phase = phase_hg(0.3, -glm::dot(host.sun_direction, ray));
                const double expected = (0.2 + 100 * phase) * 0.06 / 0.08 * (1 - transmittance);
                EXPECT_NEAR(frame.scattering.at(x, y)[0], expected, 3e-3 * expected);
                EXPECT_NEAR(frame.transmittance.at(x, y)[0], transmittance, 1e-3);
            }
    }
}

TEST_F(VolumetricsParts, EachMediumIsThatOfTheReference) {
    const float slice = 39.9F / 64;  // the froxels begin at the near plane, 0.1 m
    LocalMedium soft = box({0.5F, 0, 0}, {3, 3, 3}, 0.3F);
    soft.softness = 1;
    // Root mean square over the mean of red; what the sun's volume leaves of its light, and four steps of its
    // shadow in the air, is most of them.
    struct Case {
        std::vector<LocalMedium> media;
        double tolerance, with_attenuation;
    };
    const std::vector<Case> cases{
        {{box({0, 0, -0.1F - 12.5F * slice}, {2, 1.5F, 0.4F * slice}, 0.4F)}, 0.011, 0.01},  // in one slice
        {{box({-5, 1, -8}, {1.5F, 1.5F, 1.5F}, 0.2F)}, 0.003, 0.0035},  // over the screen's border
        {{soft}, 0.002, 0.003},                                         // round the camera
        {{box({0, 0, -5}, {9, 9, 1}, 0.3F), box({1, 0, -14}, {4, 4, 2}, 0.2F)}, 0.009, 0.035},  // with a gap
        {{box({0, 0, -30}, {9, 9, 9}, 0.3F)}, 5e-4, 0.015},  // behind the surface, before the sun
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        host.local = cases[i].media;
        for (const bool attenuation : {false, true}) {
            Settings settings = coarse(4);
            settings.light.transmittance = attenuation;
            const Frame expected = truth(settings), frame = host.render(settings);
            double red = 0;
            for (std::size_t k = 0; k < expected.scattering.pixels.size(); k += 4)
                red += 4 * expected.scattering.pixels[k];
            const auto values = static_cast<double>(expected.scattering.pixels.size());
            EXPECT_LE(std::sqrt(squared_error(frame.scattering, expected.scattering) / values) / (red / values),
                      attenuation ? cases[i].with_attenuation : cases[i].tolerance)
                << i << attenuation;
            EXPECT_LE(largest(frame.scattering, expected.scattering), 0.1) << i << attenuation;
            EXPECT_LE(largest(frame.transmittance, expected.transmittance), 0.1) << i << attenuation;
        }
    }
}

TEST_F(VolumetricsParts, VisibilityIsSampledWhereTheLightComesFrom) {
    // All pixels see the same ray, in 64 places: their mean is the whole light.
    host.size = {16, 16};
    host.vertical_fov = 0.002F;
    host.ambient = glm::vec3(0);
    host.shadows = 1;
    const float slice = 39.9F / 64;
    host.local = {box({0, 0, -0.1F - 8 * slice}, {9, 9, 2 * slice}, 0.3F),
                  box({1, 0, -0.1F - 21 * slice}, {4, 4, slice}, 0.4F)};
    host.global = {{.sigma_s = glm::vec3(0.02F)},
                   {.sigma_s = glm::vec3(0.1F), .height = true, .base = -3, .falloff = 3}};
    const auto mean = [](const Image& image) {
        double sum = 0;
        for (const float v : image.pixels) sum += v;
        return sum / static_cast<double>(image.pixels.size());
    };
    for (const bool attenuation : {false, true}) {
        for (const int steps : {1, 2, 5}) {
            Settings settings = coarse(steps);
            settings.light.transmittance = attenuation;
            const double expected = mean(truth(settings).scattering);
            EXPECT_NEAR(mean(host.render(settings).scattering), expected, 0.05 * expected) << steps << attenuation;
        }
    }
}

TEST_F(VolumetricsParts, VisibilityFollowsTheDensityOfAHeightMedium) {
    // Rays that rise out of a height medium, sampled once: most of the light comes from near the eye.
    host.size = {32, 32};
    host.vertical_fov = 1.2F;
    host.ambient = glm::vec3(0);
    host.shadows = 1;
    host.local = {box({0, -50, -10}, glm::vec3(0.5F), 0.1F)};
    host.local[0].half_extent.y = 46;
    host.global = {{.sigma_s = glm::vec3(0.05F), .height = true, .falloff = 1.5F}};
    Settings settings = coarse(1);
    settings.light.transmittance = false;
    const auto expect_alike = [&](const Settings& once, double tolerance) {
        const Image expected = truth(once).scattering, image = host.render(once).scattering;
        double difference = 0, sum = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 32; ++x) {
                difference += image.at(x, y)[0] - expected.at(x, y)[0];
                sum += expected.at(x, y)[0];
            }
        EXPECT_NEAR(difference / sum, 0, tolerance);
    };
    expect_alike(settings, 0.02);
    host.local.clear();
    expect_alike(settings, 0.02);
    Settings light = settings;
    light.filter.reconstruct = volumetrics::Reconstruct::light;
    expect_alike(light, 0.04);
}

// A part costs a sample of the global media, and one of each local medium in it.
TEST_F(VolumetricsParts, OnlyMediaOnTheRayCostAndDenseOnesMore) {
    Settings settings = coarse(4);
    settings.light.transmittance = false;
    EXPECT_EQ(samples(settings), 4);
    host.local = {box({0, 0, -8}, glm::vec3(0.5F), 0.2F)};
    EXPECT_LE(samples(settings), 6);  // few pixels see it
    host.local = {box(glm::vec3(0), glm::vec3(1000), 0.001F)};
    const double thin = samples(settings);
    EXPECT_LE(thin, 2 * (4 + 1));
    host.local = {box(glm::vec3(0), glm::vec3(1000), 2)};
    EXPECT_GT(samples(settings), thin);
    EXPECT_LE(samples(settings), 2 * (4 + 12));
}

TEST_F(VolumetricsRelight, FrameSaysWhyLightIsFilteredWhole) {
    light_everything();
    const auto reason = [&](const Settings& settings) {
        return host.render(settings).skipped.at("volumetrics/relight");
    };
    EXPECT_EQ(reason(filtered(Reconstruct::light)), "reconstruct is light");
    Settings settings = filtered(Reconstruct::visibility);
    EXPECT_FALSE(host.render(settings).skipped.contains("volumetrics/relight"));
    settings.filter.kernel = Filter::none;
    EXPECT_EQ(reason(settings), "nothing filters visibility");
    settings = filtered(Reconstruct::visibility);
    settings.light.lamp_integration = volumetrics::LampIntegration::center;
    EXPECT_EQ(reason(settings), "lamp_integration is center: unshadowed light is noisy, too");
    host.lights.clear();
    host.has_sun = false;
    EXPECT_EQ(reason(filtered(Reconstruct::visibility)), "no sun and no lamps");
}

}  // namespace
}  // namespace tyndall::test
