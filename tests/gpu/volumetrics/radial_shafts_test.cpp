// The technique radial_shafts against geometry: a wall with a window, a post, an empty screen; and the sun on its
// way out of the picture.

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;
using volumetrics::RadialOcclusion;

constexpr std::array both{RadialOcclusion::coverage, RadialOcclusion::intervals};

class RadialShafts : public GlTest {
  protected:
    RadialShafts() {
        host.has_sun = true;
        host.sun_illuminance = glm::vec3(1000);
        host.global = {{.sigma_s = glm::vec3(0.01F), .anisotropy = 0.5F}};
    }
    [[nodiscard]] static Settings settings(RadialOcclusion occlusion) {
        Settings settings = plain_settings(1);
        settings.technique = "radial_shafts";
        settings.radial_occlusion = occlusion;
        return settings;
    }
    [[nodiscard]] Frame fog(const std::string& technique = "analytic_fog") {
        Settings settings = plain_settings(1);
        settings.technique = technique;
        return host.render(settings);
    }
    /// Places the sun at normalised device coordinates; in front of the camera, or behind it.
    void put_sun(float x, float y, float sign = 1) {
        const glm::mat4 p = host.projection();
        host.sun_direction = -glm::normalize(sign * glm::vec3(x / p[0][0], y / p[1][1], -1));
    }
    StubHost host;
};

double relative(double value, double expected) {
    return std::abs(value - expected) / std::abs(expected);
}

TEST_F(RadialShafts, WithoutOccludersItIsTheClosedForm) {
    host.size = {24, 16};
    host.global.push_back({.sigma_s = {0.01F, 0.02F, 0.03F}, .height = true, .falloff = 5});
    host.eye = {0, 2, 0};
    host.ambient = glm::vec3(5);
    host.view_depth = [](int, int) { return sky; };
    for (const glm::vec2 at : {glm::vec2(0, 0.9F), {0.7F, 0.1F}, {-1.2F, 0.5F}, {0.3F, 5}, {40, 3}})
        for (const float sign : {1.0F, -1.0F}) {
            put_sun(at.x, at.y, sign);
            const Frame expected = fog();
            for (const RadialOcclusion occlusion : both) {
                const Frame frame = host.render(settings(occlusion));
                EXPECT_EQ(frame.scattering.pixels, expected.scattering.pixels)
                    << at.x << ' ' << at.y << ' ' << sign;
                EXPECT_EQ(frame.transmittance.pixels, expected.transmittance.pixels);
            }
        }
}

TEST_F(RadialShafts, AFloorDoesNotShadowItself) {
    // At y = 0, up to the horizon; its outline is known to half a pixel.
    host.size = {32, 64};
    host.eye = {0, 2, 0};
    host.view_depth = [&](int x, int y) { return y < 32 ? -2 * host.ray(x, y).z / -host.ray(x, y).y : sky; };
    for (const glm::vec2 at : {glm::vec2(0, 0.9F), {0.7F, 0.1F}, {-1.2F, 0.5F}}) {
        put_sun(at.x, at.y);
        const Image lit = fog().scattering;
        for (const RadialOcclusion occlusion : both) {
            const Image image = host.render(settings(occlusion)).scattering;
            double mean = 0;
            for (int i = 0; i < 32 * 64; ++i) {
                const double share = image.at(i % 32, i / 32)[0] / lit.at(i % 32, i / 32)[0];
                EXPECT_GE(share, 0.85) << i % 32 << ' ' << i / 32;
                mean += share / (32 * 64);
            }
            EXPECT_GE(mean, 0.99);
        }
    }
}

TEST_F(RadialShafts, WithoutSunItIsTheClosedForm) {
    host.has_sun = false;
    host.ambient = glm::vec3(1);
    const Frame frame = host.render(settings(RadialOcclusion::intervals));
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/analytic_fog"));
    EXPECT_EQ(frame.skipped.at("volumetrics/radial_shafts"), "no sun");
    EXPECT_EQ(frame.scattering.pixels, fog().scattering.pixels);
}

TEST_F(RadialShafts, LightThroughAWindowFallsWhereGeometrySaysSo) {
    // A wall across the view at 20 m with a window, columns 60 to 79 of 128, the sun behind it at column 95.5.
    host.size = {128, 1};
    host.vertical_fov = 0.01F;  // 1.28 wide
    constexpr double wall = 20;
    host.view_depth = [](int x, int) { return x >= 60 && x < 80 ? sky : float(wall); };
    put_sun(2 * 95.5F / 128 - 1, 0);
    for (const float sigma : {1e-5F, 0.05F}) {
        host.global = {{.sigma_s = glm::vec3(sigma)}};
        const Frame lit = fog();
        for (const RadialOcclusion occlusion : both) {
            if (occlusion == RadialOcclusion::coverage && sigma > 1e-3F) continue;  // it knows no attenuation
            Settings s = settings(occlusion);
            s.radial_samples = 256;
            const Frame frame = host.render(s);
            for (int x = 0; x < 128; x += 5) {
                // The point at view depth z meets the wall at column x + (95.5 - x) (1 - z / wall).
                if (host.view_depth(x, 0) == sky) continue;
                const double centre = x + 0.5;
                double sum = 0, all = 0;
                for (int i = 0; i < 4000; ++i) {
                    const double z = wall * (i + 0.5) / 4000;
                    const double column = centre + (95.5 - centre) * (1 - z / wall);
                    const double light = std::exp(-sigma * z / -host.ray(x, 0).z);
                    all += light;
                    if (column >= 60 && column < 80) sum += light;
                }
                EXPECT_NEAR(frame.scattering.at(x, 0)[0] / lit.scattering.at(x, 0)[0], sum / all, 0.04)
                    << x << ' ' << sigma << ' ' << int(occlusion);
            }
        }
    }
}

TEST_F(RadialShafts, APostDarkensWhatLiesBehindItAsSeenFromTheSun) {
    host.size = {64, 1};
    host.vertical_fov = 0.01F;
    put_sun(0.5F, 0);  // column 48
    host.global[0].sigma_s = glm::vec3(0.1F);
    host.view_depth = [](int x, int) { return x >= 30 && x < 36 ? 5.0F : sky; };
    const Frame lit = fog();
    for (const RadialOcclusion occlusion : both) {
        Settings s = settings(occlusion);
        s.radial_samples = 64;
        const Frame frame = host.render(s);
        const auto share = [&](int x) { return frame.scattering.at(x, 0)[0] / lit.scattering.at(x, 0)[0]; };
        for (int x = 36; x < 64; ++x) EXPECT_EQ(share(x), 1) << x;
        for (int x = 0; x < 30; ++x) EXPECT_LT(share(x), 1) << x;
        for (int x = 0; x < 64; ++x) EXPECT_GE(share(x), 0) << x;
    }
    // What a post far behind the surface of a pixel covers on screen, it does not shadow.
    host.view_depth = [](int x, int) { return x >= 30 && x < 36 ? 500.0F : x < 20 ? 3.0F : sky; };
    const Frame near = fog();
    for (const RadialOcclusion occlusion : both) {
        const Frame frame = host.render(settings(occlusion));
        // But for half a pixel of its own surface.
        EXPECT_LE(relative(frame.scattering.at(19, 0)[0], near.scattering.at(19, 0)[0]), 0.04);
    }
}

TEST_F(RadialShafts, OccludedSunIsDarkAndDecayWeighs) {
    host.size = {64, 1};
    host.vertical_fov = 0.01F;
    put_sun(0.5F, 0);
    host.view_depth = [](int, int) { return 30.0F; };  // a wall over the whole picture
    for (const RadialOcclusion occlusion : both)
        EXPECT_EQ(host.render(settings(occlusion)).scattering.at(3, 0)[0], 0);
    host.ambient = glm::vec3(2);
    host.has_sun = false;
    const float glow = fog().scattering.at(3, 0)[0];
    host.has_sun = true;
    EXPECT_EQ(host.render(settings(RadialOcclusion::intervals)).scattering.at(3, 0)[0], glow);

    // Half of the way is covered, the half at the sun: it weighs int_1/2^1 r^u du of int_0^1 r^u du.
    host.ambient = glm::vec3(0);
    host.view_depth = [](int x, int) { return x >= 24 ? 30.0F : sky; };
    const double lit = fog().scattering.at(0, 0)[0];
    for (const float decay : {0.01F, 0.5F, 1.0F, 20.0F}) {
        Settings s = settings(RadialOcclusion::coverage);
        s.radial_decay = decay;
        s.radial_samples = 512;
        const double r = decay, covered = decay == 1.0F ? 0.5 : (r - std::sqrt(r)) / (r - 1);
        EXPECT_NEAR(host.render(s).scattering.at(0, 0)[0] / lit, 1 - covered, 0.02) << decay;
    }
}

TEST_F(RadialShafts, TheSunLeavesThePictureWithoutAPop) {
    host.size = {16, 16};
    host.vertical_fov = 1.2F;
    host.global[0].anisotropy = 0;  // so that what changes is visibility alone
    host.view_depth = [](int x, int y) { return (x / 3 + y / 3) % 2 == 0 ? 4.0F + float(x) : sky; };
    for (const float unseen : {1.0F, 0.25F})
        for (const RadialOcclusion occlusion : both) {
            Settings s = settings(occlusion);
            s.radial_unseen = unseen;
            s.radial_samples = 64;
            put_sun(0, 0);
            const Image lit = fog().scattering;
            Frame frame;
            double before = -1, step = 0;
            int at = 0;
            for (int i = 0; i <= 720; ++i) {  // half a turn to the side and up, in steps of a quarter of a degree
                const float angle = float(i) * std::numbers::pi_v<float> / 720;
                host.sun_direction =
                    glm::normalize(glm::vec3(-std::sin(angle), -0.3F * std::sin(angle), std::cos(angle)));
                frame = host.render(s);
                double mean = 0;
                for (std::size_t p = 0; p < frame.scattering.pixels.size(); p += 4) {
                    const double share = frame.scattering.pixels[p] / lit.pixels[p];
                    ASSERT_TRUE(share >= 0 && share < 1.001) << share << " at step " << i;
                    mean += share / 256;
                }
                if (before >= 0 && std::abs(mean - before) > step) {
                    step = std::abs(mean - before);
                    at = i;
                }
                before = mean;
            }
            EXPECT_LE(step, 0.02) << int(occlusion) << " at step " << at;
            for (std::size_t p = 0; p < frame.scattering.pixels.size(); p += 4)
                EXPECT_LE(relative(frame.scattering.pixels[p], unseen * lit.pixels[p]), 2e-3);
        }
}

TEST_F(RadialShafts, IsLinearInTheSun) {
    host.size = {32, 1};
    host.vertical_fov = 0.1F;
    host.view_depth = [](int x, int) { return x % 7 < 3 ? 5.0F : 40.0F; };
    put_sun(0.4F, 0);
    for (const RadialOcclusion occlusion : both) {
        host.sun_illuminance = glm::vec3(1000);
        const Image once = host.render(settings(occlusion)).scattering;
        host.sun_illuminance = glm::vec3(7000);
        const Image seven = host.render(settings(occlusion)).scattering;
        for (int x = 0; x < 32; ++x) EXPECT_NEAR(seven.at(x, 0)[0], 7 * once.at(x, 0)[0], 2e-3 * seven.at(x, 0)[0]);
    }
}

TEST_F(RadialShafts, WorkIsThatOfItsSamplesAndNoneWithTheSunBehind) {
    host.count_work = true;
    host.size = {8, 8};
    Settings s = settings(RadialOcclusion::coverage);
    s.radial_samples = 20;
    put_sun(0.1F, 0.1F);
    EXPECT_EQ(host.render(s).work.at("volumetrics/radial_visibility")[int(gl::Work::texture_fetches)], 64U * 21);
    put_sun(0.1F, 0.1F, -1);
    const gl::WorkCounts work = host.render(s).work.at("volumetrics/radial_visibility");
    EXPECT_EQ(work[int(gl::Work::texture_fetches)], 64U);
    EXPECT_EQ(work[int(gl::Work::shadow_lookups)], 0U);
    EXPECT_THAT(host.render(s).live_passes,
                ElementsAre("volumetrics/radial_visibility", "volumetrics/radial_shafts"));
}

TEST_F(RadialShafts, BlurTakesTheNoiseOfTheDitherAndLeavesTheFog) {
    host.size = {32, 32};
    host.eye = {0, 2, 0};
    host.global = {{.sigma_s = glm::vec3(0.2F), .height = true, .falloff = 0.5F}};
    host.view_depth = [](int, int) { return sky; };
    put_sun(0.2F, 0.9F);
    Settings s = settings(RadialOcclusion::intervals);
    s.filter = volumetrics::Filter::gaussian15;
    const Frame frame = host.render(s);
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/radial_visibility", "volumetrics/filter_horizontal",
                                               "volumetrics/filter_vertical", "volumetrics/radial_shafts"));
    // The fog's edge at the horizon stays as sharp as it is.
    EXPECT_EQ(frame.scattering.pixels, fog().scattering.pixels);
}

TEST_F(RadialShafts, ExtremesStayFiniteAndBounded) {
    host.size = {5, 7};
    host.sun_illuminance = glm::vec3(4);
    host.view_depth = [](int x, int y) { return x == 0 ? sky : std::pow(10.0F, static_cast<float>(y - 3)); };
    for (const float fov : {0.02F, 2.9F})
        for (const float znear : {0.001F, 10.0F})
            for (const glm::vec3 sun :
                 {glm::vec3(1, 0, 0), {1, 0, 1e-7F}, {0, 0, 1}, {0, -1e-7F, 1}, {0, -1, 0}, {0, 0, -1}})
                for (const float sigma : {1e-30F, 1.0F, 1e4F})
                    for (const float base : {-1e6F, 0.0F, 1e6F}) {
                        host.vertical_fov = fov;
                        host.znear = znear;
                        host.sun_direction = glm::normalize(sun);
                        const glm::vec3 sigma_s{sigma, 0, sigma}, sigma_a{0, sigma, 0};
                        host.global = {{.sigma_s = sigma_s, .sigma_a = sigma_a},
                                       {.sigma_s = sigma_s, .height = true, .base = base, .falloff = 10}};
                        for (const RadialOcclusion occlusion : both) {
                            Settings s = settings(occlusion);
                            s.radial_samples = sigma == 1 ? 512 : 3;
                            s.radial_decay = base == 0 ? 100 : 0.01F;
                            const Frame frame = host.render(s);
                            // Sun of 4 lx scattered isotropically is less than 1/pi.
                            for (int i = 0; i < 35; ++i)
                                for (int c = 0; c < 3; ++c) {
                                    const float v = frame.scattering.at(i % 5, i / 5)[c];
                                    const float t = frame.transmittance.at(i % 5, i / 5)[c];
                                    ASSERT_TRUE(v >= 0 && v <= 0.33F) << v << ' ' << sigma << ' ' << base;
                                    ASSERT_TRUE(t >= 0 && t <= 1) << t;
                                }
                        }
                    }
}

}  // namespace
}  // namespace tyndall::test
