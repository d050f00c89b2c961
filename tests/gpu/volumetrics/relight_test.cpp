// The setting reconstruct = visibility.

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
        settings.noise = volumetrics::Noise::bayer;
        settings.filter = Filter::gaussian15;
        settings.filter_sigma = 2;
        settings.filter_depth = volumetrics::FilterDepth::none;
        settings.reconstruct = reconstruct;
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

TEST_F(VolumetricsRelight, LitSceneIsAsSharpAsWithoutAFilter) {
    light_everything();
    host.view_depth = [](int x, int y) { return x < 10 ? 6.0F : y < 6 ? sky : 15.0F; };
    for (const glm::vec3 sigma_a : {glm::vec3(0.01F), glm::vec3(0, 0.02F, 0.1F)}) {
        host.global[0].sigma_a = sigma_a;
        Settings sharp = filtered(Reconstruct::light);
        sharp.filter = Filter::none;
        sharp.noise = volumetrics::Noise::none;
        const Frame expected = host.render(sharp);
        const Frame frame = host.render(filtered(Reconstruct::visibility));
        EXPECT_LE(largest(frame.scattering, expected.scattering), rounding);
        EXPECT_LE(largest(frame.transmittance, expected.transmittance), 1e-6);
        // The glow of the lamps is what the filter takes away elsewhere.
        EXPECT_GT(largest(host.render(filtered(Reconstruct::light)).scattering, expected.scattering), 0.1);
    }
}

TEST_F(VolumetricsRelight, EachLightAloneIsExactToo) {
    Settings sharp = filtered(Reconstruct::light);
    sharp.filter = Filter::none;
    for (const bool sun : {true, false}) {
        light_everything();
        host.has_sun = sun;
        if (sun) host.lights.clear();
        const Frame expected = host.render(sharp);
        EXPECT_LE(largest(host.render(filtered(Reconstruct::visibility)).scattering, expected.scattering),
                  rounding);
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
    host.lights.clear();
    Settings settings = filtered(Reconstruct::light);
    settings.filter = Filter::none;
    EXPECT_LE(largest(frame.scattering, host.render(settings).scattering), rounding);
}

TEST_F(VolumetricsRelight, ShadowEdgesHaveNoMoreErrorThanFilteredLight) {
    light_everything();
    host.ambient = glm::vec3(0);
    for (const int shadows : {1, 2, 3}) {
        host.shadows = shadows;
        Settings truth = plain_settings(64);
        const Image expected = host.render(truth).scattering;
        const double light = squared_error(host.render(filtered(Reconstruct::light)).scattering, expected);
        const double visibility =
            squared_error(host.render(filtered(Reconstruct::visibility)).scattering, expected);
        EXPECT_LT(visibility, light) << "shadows " << shadows;
    }
}

TEST_F(VolumetricsRelight, PixelsWithoutLightDoNotDimTheirNeighbours) {
    // A spot whose cone ends inside the picture: outside of it there is no light and no visibility.
    host.lights = {spot_light({0, 2, -5}, {0, -1, 0}, 50, 0.95F, 0.9F)};
    Settings sharp = filtered(Reconstruct::light);
    sharp.filter = Filter::none;
    const Image expected = host.render(sharp).scattering;
    const Image image = host.render(filtered(Reconstruct::visibility)).scattering;
    int dark = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) {
            dark += expected.at(x, y)[0] == 0;
            EXPECT_NEAR(image.at(x, y)[0], expected.at(x, y)[0], rounding * expected.at(x, y)[0] + 1e-5)
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
    // A box of fog in fog, all lit: within the froxels' resolution of 256 steps; the filter leaves no error of its
    // own.
    light_everything();
    host.local.resize(1);
    host.local[0].box = true;
    host.local[0].center = {1, 0, -8};
    host.local[0].half_extent = {2, 1, 2};
    host.local[0].sigma_s = glm::vec3(0.3F);
    host.view_depth = [](int, int) { return 20.0F; };
    const Image expected = host.render(plain_settings(64)).scattering;
    const double light = squared_error(host.render(filtered(Reconstruct::light)).scattering, expected);
    const double visibility = squared_error(host.render(filtered(Reconstruct::visibility)).scattering, expected);
    EXPECT_LT(visibility, light);
}

TEST_F(VolumetricsRelight, FrameSaysWhyLightIsFilteredWhole) {
    light_everything();
    const auto reason = [&](const Settings& settings) {
        return host.render(settings).skipped.at("volumetrics/relight");
    };
    EXPECT_EQ(reason(filtered(Reconstruct::light)), "reconstruct is light");
    Settings settings = filtered(Reconstruct::visibility);
    EXPECT_FALSE(host.render(settings).skipped.contains("volumetrics/relight"));
    settings.filter = Filter::none;
    EXPECT_EQ(reason(settings), "nothing filters visibility");
    settings = filtered(Reconstruct::visibility);
    settings.lamp_integration = volumetrics::LampIntegration::center;
    EXPECT_EQ(reason(settings), "lamp_integration is center: unshadowed light is noisy, too");
    host.lights.clear();
    host.has_sun = false;
    EXPECT_EQ(reason(filtered(Reconstruct::visibility)), "no sun and no lamps");
}

}  // namespace
}  // namespace tyndall::test
