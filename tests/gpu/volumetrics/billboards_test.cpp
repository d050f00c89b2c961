// The technique billboards: its layers' transmittance and light against closed forms, and where it may not fail.

#include <gmock/gmock.h>

#include <cmath>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/low_resolution.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;

class VolumetricsBillboards : public GlTest {
  protected:
    VolumetricsBillboards() { s.technique = "billboards"; }

    StubHost host;
    Settings s = without_fade();
    static Settings without_fade() {
        Settings settings = plain_settings(1);
        settings.billboards.fade = 0;
        return settings;
    }
    /// A row of pixels that look in one direction, at depths from 0.2 m to 180 m.
    void row_of_depths() {
        host.size = {64, 1};
        host.vertical_fov = 1e-4F;
        host.view_depth = [](int x, int) { return depth(x); };
    }
    static float depth(int x) { return 0.2F * std::exp(0.108F * static_cast<float>(x)); }
};

TEST_F(VolumetricsBillboards, TransmittanceIsBeerLambertAtEveryDepth) {
    row_of_depths();
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0, 0.01F, 0.04F)},
                   {.sigma_s = glm::vec3(0.02F), .height = true, .base = 1, .falloff = 3}};
    const double height = 0.02 * std::exp(1.0 / 3);  // a level ray at y = 0
    for (const int layers : {1, 7, 64}) {
        s.billboards.layers = layers;
        const Frame frame = host.render(s);
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) {
                const double sigma_t = 0.01 + height + host.global[0].sigma_a[c];
                ASSERT_NEAR(frame.transmittance.at(x, 0)[c], std::exp(-sigma_t * depth(x)), 1e-3)
                    << depth(x) << " m, layers " << layers;
            }
    }
}

TEST_F(VolumetricsBillboards, SunIsTheClosedFormInAHomogeneousMedium) {
    row_of_depths();
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.4F));
    host.sun_illuminance = glm::vec3(1000);
    host.global = {{.sigma_s = glm::vec3(0.02F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.5F}};
    const double source = 1000 * phase_hg(0.5, host.sun_direction.z) * 0.02 / 0.03;
    for (const int layers : {1, 16}) {
        s.billboards.layers = layers;
        const Frame frame = host.render(s);
        for (int x = 0; x < 64; ++x) {
            const double expected = source * -std::expm1(-0.03 * depth(x));
            ASSERT_NEAR(frame.scattering.at(x, 0)[0], expected, 2e-3 * expected) << depth(x) << " m";
        }
    }
}

TEST_F(VolumetricsBillboards, WhereTheSunIsAttenuatedMoreLayersAreBetter) {
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int, int) { return 60.0F; };
    host.has_sun = true;
    host.sun_direction = {0, -1, 0};
    // Two media, so that one falls off along the way of the light and the eye looks up through it.
    host.global = {{.sigma_s = glm::vec3(0.1F), .height = true, .falloff = 4}};
    host.vertical_fov = 1.2F;
    host.size = {1, 3};
    const glm::dvec3 up = host.ray(0, 2);
    const double end = 60 / -up.z;
    double expected = 0;
    constexpr int samples = 20000;
    for (int i = 0; i < samples; ++i) {
        const double t = end * (i + 0.5) / samples, y = t * up.y;
        const double to_eye = 0.1 * 4 / up.y * -std::expm1(-y / 4), to_sun = 0.1 * 4 * std::exp(-y / 4);
        expected += 0.1 * std::exp(-y / 4 - to_eye - to_sun) * end / samples;
    }
    expected *= phase_hg(0, 0);
    const auto error = [&](int layers) {
        s.billboards.layers = layers;
        return std::abs(host.render(s).scattering.at(0, 0)[0] / expected - 1);
    };
    EXPECT_GT(error(4), 4 * error(16));
    EXPECT_LT(error(64), 5e-3);
}

TEST_F(VolumetricsBillboards, LampsConvergeWithTheLayers) {
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.02F)}};
    host.lights = {point_light({2, 0, -12}, 100)};
    double expected = 0;
    constexpr int samples = 40000;
    for (int i = 0; i < samples; ++i) {
        const double t = 40.0 * (i + 0.5) / samples, d2 = 4 + (t - 12) * (t - 12);
        expected += 0.02 * phase_hg(0, 0) * 100 / d2 * std::exp(-0.02 * (t + std::sqrt(d2))) * 40 / samples;
    }
    const auto error = [&](int layers) {
        s.billboards.layers = layers;
        return std::abs(host.render(s).scattering.at(0, 0)[0] / expected - 1);
    };
    EXPECT_GT(error(8), 0.02);  // a lamp between the sheets: the technique's failure
    EXPECT_LT(error(256), 5e-3);
}

/// Mean of 55 frames whose offsets leave no gap over 1.18 / 55.
Image mean_over_frames(StubHost& host, Settings s) {
    constexpr int frames = 55;
    s.noise.kind = volumetrics::Noise::bayer;
    s.noise.time = volumetrics::NoiseTime::golden_ratio;
    Image mean;
    for (int frame = 0; frame < frames; ++frame) {
        host.frame_index = static_cast<std::uint32_t>(frame);
        const Image image = host.render(s).scattering;
        if (frame == 0) mean = Image(image.size, image.channels);
        for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] += image.pixels[i] / frames;
    }
    return mean;
}

// Rays that pass from light into the shadow of a half plane, each at another depth. The middle of a sheet is lit or
// not.
TEST_F(VolumetricsBillboards, MeanOverFramesIsTheLitShareOfEachSheet) {
    host.size = {32, 1};
    host.vertical_fov = 0.04F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(-0.5F, -1, 0));
    host.shadows = 3;
    host.global = {{.sigma_s = glm::vec3(0.001F)}};
    s.billboards.layers = 4;
    s.march.max_distance = 40;
    // At y = 0 the light of x = -2 on passes the edge.
    const auto lit = [&](int x) {
        const glm::vec3 ray = host.ray(x, 0);
        return (ray.x < 0 ? std::min(2 * ray.z / ray.x, 40.0F) : 40.0F) / -ray.z;
    };
    const double source = 0.001 * phase_hg(0, 0), whole = source * 40;
    const Frame fixed = host.render(s);
    const Image mean = mean_over_frames(host, s);
    double bias = 0;
    for (int x = 0; x < 32; ++x) {
        const double expected = source * -std::expm1(-0.001 * lit(x)) / 0.001;
        bias = std::max(bias, std::abs(fixed.scattering.at(x, 0)[0] - expected));
        ASSERT_NEAR(mean.at(x, 0)[0], expected, 0.02 * whole) << x;
    }
    EXPECT_GT(bias, 0.15 * whole) << "the middle stands for 24 m";
    s.noise.kind = volumetrics::Noise::white;
    EXPECT_EQ(host.render(s).transmittance.pixels, fixed.transmittance.pixels)
        << "what is not sampled has no noise";
}

TEST_F(VolumetricsBillboards, MeanOverFramesIsTheGlowOfALamp) {
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.lights = {point_light({2, 0, -12}, 100)};
    s.billboards.layers = 8;
    for (const double sigma : {0.002, 0.3}) {  // of a dense medium only the front of each sheet is seen
        host.global = {{.sigma_s = glm::vec3(sigma)}};
        double expected = 0;
        constexpr int samples = 40000;
        for (int i = 0; i < samples; ++i) {
            const double t = 40.0 * (i + 0.5) / samples, d2 = 4 + (t - 12) * (t - 12);
            expected += sigma * phase_hg(0, 0) * 100 / d2 * std::exp(-sigma * (t + std::sqrt(d2))) * 40 / samples;
        }
        EXPECT_GT(std::abs(host.render(s).scattering.at(0, 0)[0] / expected - 1), 0.04) << sigma;
        EXPECT_NEAR(mean_over_frames(host, s).at(0, 0)[0], expected, 0.03 * expected) << sigma;
    }
}

TEST_F(VolumetricsBillboards, OneSheetOfASoftBallHasItsMeanDensity) {
    // Through the centre of a ball of radius 5 m, dense 1 in its inner 2 m. The mean optical depth is half that of
    // the ramps and all of the core.
    host.vertical_fov = 1e-4F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.local = {{.center = {0, 0, -20}, .half_extent = {5, 5, 5}, .softness = 3, .sigma_a = glm::vec3(0.01F)}};
    s.billboards.local_layers = 1;
    EXPECT_NEAR(host.render(s).transmittance.at(0, 0)[0], std::exp(-0.01 * (4 + 3)), 2e-3);
}

TEST_F(VolumetricsBillboards, LowerResolutionIsTheSameWhereLightIsSmooth) {
    host.vertical_fov = 0.1F;
    host.view_depth = [](int, int) { return 12.0F; };
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.4F));
    host.ambient = glm::vec3(0.1F);
    host.global = {{.sigma_s = {0.02F, 0.03F, 0.05F}, .anisotropy = 0.5F}};
    host.local = {
        {.shape = Shape::box, .center = {0, 0, -8}, .half_extent = {20, 20, 3}, .sigma_s = glm::vec3(0.05F)}};
    host.lights = {point_light({3, 4, -9}, 10)};
    for (const glm::ivec2 size : low_resolution_sizes) {
        host.size = size;
        s.resolution.size = volumetrics::Resolution::full;
        const Frame full = host.render(s);
        for (const auto resolution : {volumetrics::Resolution::half, volumetrics::Resolution::quarter}) {
            s.resolution.size = resolution;
            const Frame low = host.render(s);
            const double tolerance = resolution == volumetrics::Resolution::half ? 0.02 : 0.05;
            EXPECT_LT(largest_difference(low.scattering, full.scattering), tolerance) << size.x << " px";
            EXPECT_LT(largest_difference(low.transmittance, full.transmittance), 5e-3) << size.x << " px";
        }
    }
}

TEST_F(VolumetricsBillboards, FadeTakesHalfItsLengthOfMedium) {
    row_of_depths();
    s.billboards.fade = 4;
    s.billboards.layers = 256;
    s.march.max_distance = 32;
    host.global = {{.sigma_s = glm::vec3(0.05F)}};
    host.ambient = glm::vec3(1);
    const Frame frame = host.render(s);
    for (int x = 0; x < 64; ++x) {
        const double d = depth(x), medium = d < 4 ? d * d / 8 : d - 2;
        ASSERT_NEAR(frame.transmittance.at(x, 0)[0], std::exp(-0.05 * medium), 2e-3) << d << " m";
        ASSERT_NEAR(frame.scattering.at(x, 0)[0], -std::expm1(-0.05 * medium), 2e-3) << d << " m";
    }
}

TEST_F(VolumetricsBillboards, LocalMediaAreTheChordInTheirShape) {
    row_of_depths();
    host.local = {
        {.shape = Shape::box, .center = {0, 0, -20}, .half_extent = {5, 5, 8}, .sigma_s = glm::vec3(0.08F)},
        {.center = {0, 0, -50}, .half_extent = {6, 6, 6}, .sigma_a = glm::vec3(0.05F)}};
    host.ambient = glm::vec3(3);
    const auto chord = [](double d, double from, double to) { return std::clamp(d, from, to) - from; };
    for (const int layers : {1, 8}) {
        s.billboards.local_layers = layers;
        const Frame frame = host.render(s);
        for (int x = 0; x < 64; ++x) {
            const double box = 0.08 * chord(depth(x), 12, 28), ball = 0.05 * chord(depth(x), 44, 56);
            ASSERT_NEAR(frame.transmittance.at(x, 0)[0], std::exp(-box - ball), 1e-3) << depth(x) << " m";
            ASSERT_NEAR(frame.scattering.at(x, 0)[0], 3 * -std::expm1(-box), 4e-3) << depth(x) << " m";
        }
    }
}

TEST_F(VolumetricsBillboards, LocalMediaAreDrawnWhereTheyAre) {
    host.size = {48, 32};
    host.view_depth = [](int, int) { return sky; };
    const glm::vec3 center{3, -2, -14}, radii{4, 2, 3};
    host.local = {{.center = center, .half_extent = radii, .sigma_a = glm::vec3(0.3F)}};
    const Frame frame = host.render(s);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
            const glm::dvec3 o = -glm::dvec3(center) / glm::dvec3(radii),
                             d = glm::dvec3(host.ray(x, y)) / glm::dvec3(radii);
            const double a = glm::dot(d, d), b = glm::dot(o, d), root = b * b - a * (glm::dot(o, o) - 1);
            const double chord = root > 0 ? 2 * std::sqrt(root) / a : 0;
            ASSERT_NEAR(frame.transmittance.at(x, 31 - y)[0], std::exp(-0.3 * chord), 2e-3) << x << ", " << y;
        }
}

TEST_F(VolumetricsBillboards, UnderEqualLightFromAllSidesNothingIsGainedOrLost) {
    host.size = {24, 16};
    host.view_depth = [](int x, int y) { return x % 5 == 0 ? sky : 1.0F + 3.0F * static_cast<float>(x + y); };
    host.ambient = glm::vec3(1);
    host.global = {{.sigma_s = {0.01F, 0.03F, 0.09F}}, {.sigma_s = glm::vec3(0.05F), .height = true, .falloff = 5}};
    host.local = {{.center = {0, 0, -9}, .half_extent = {3, 3, 3}, .softness = 1, .sigma_s = {0.5F, 0.1F, 0.3F}},
                  {.shape = Shape::box, .center = {1, 1, 0}, .half_extent = {2, 2, 2}, .sigma_s = glm::vec3(0.2F)}};
    const Frame frame = host.render(s);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(frame.scattering.at(x, y)[c] + frame.transmittance.at(x, y)[c], 1, 2e-3)
                    << x << ", " << y;
}

TEST_F(VolumetricsBillboards, NothingBehindAWallIsSeen) {
    host.size = {16, 16};
    host.ambient = glm::vec3(1);
    host.local = {{.center = {0, 0, -20}, .half_extent = {6, 6, 6}, .sigma_s = glm::vec3(1)}};
    host.view_depth = [](int, int) { return 13.9F; };
    const Frame frame = host.render(s);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            ASSERT_EQ(frame.scattering.at(x, y)[0], 0);
            ASSERT_EQ(frame.transmittance.at(x, y)[0], 1);
        }
}

TEST_F(VolumetricsBillboards, LightIsLinearAndWithoutLightThereIsNone) {
    host.size = {16, 12};
    host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.4F}};
    host.local = {{.center = {0, 0, -6}, .half_extent = {2, 2, 2}, .sigma_s = glm::vec3(0.3F)}};
    const Frame dark = host.render(s);
    host.has_sun = true;
    host.shadows = 1;
    host.lights = {point_light({1, 1, -5}, 50)};
    const Frame once = host.render(s);
    const Frame again = host.render(s);
    host.sun_illuminance *= 4.0F;
    host.lights[0].intensity_radius *= glm::vec4(4, 4, 4, 1);
    const Frame four = host.render(s);
    double sum = 0;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) {
            const float value = once.scattering.at(x, y)[0];
            ASSERT_EQ(dark.scattering.at(x, y)[0], 0);
            ASSERT_EQ(again.scattering.at(x, y)[0], value);
            ASSERT_NEAR(four.scattering.at(x, y)[0], 4 * value, 1e-3 * value);
            sum += value;
        }
    EXPECT_GT(sum, 0);
}

TEST_F(VolumetricsBillboards, FiniteAtTheExtremes) {
    host.size = {24, 16};
    host.view_depth = [](int x, int) { return x < 8 ? sky : x < 16 ? 0.11F : 5.0F; };
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1e8F);
    host.ambient = glm::vec3(1e8F);
    host.lights = {point_light({0, 0, 0}, 1e8F, 100, 0)};
    s.billboards.fade = 0.5F;
    for (const float sigma : {1e-6F, 1e4F})
        for (const float y : {0.0F, -1e6F}) {
            if (sigma == 1e4F) reconstruct_all(s);
            host.eye = {0, y, 0};
            host.global = {{.sigma_s = glm::vec3(sigma), .anisotropy = 0.999F},
                           {.sigma_s = glm::vec3(sigma, 0, sigma), .height = true, .falloff = 1}};
            host.local = {
                {.center = host.eye, .half_extent = {3, 3, 3}, .softness = 1, .sigma_s = glm::vec3(sigma)},
                {.center = host.eye - glm::vec3(0, 0, 2), .half_extent = {0, 1, 1}, .sigma_a = glm::vec3(sigma)}};
            const Frame frame = host.render(s);
            for (const float value : frame.scattering.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0);
            for (const float value : frame.transmittance.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
        }
}

TEST_F(VolumetricsBillboards, PassesAndWork) {
    host.count_work = true;
    host.size = {8, 8};
    host.view_depth = [](int, int) { return sky; };
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    s.billboards.layers = 12;
    const Frame frame = host.render(s);
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/billboards", "volumetrics/billboards_resolve"));
    EXPECT_EQ(frame.work.at("volumetrics/billboards")[int(gl::Work::shadow_lookups)], 64U * 12);
    EXPECT_EQ(frame.work.at("volumetrics/billboards")[int(gl::Work::medium_samples)], 64U * 13);  // and the horizon
    // Of sheets behind a wall nothing is shaded.
    host.view_depth = [](int, int) { return 0.2F; };
    EXPECT_EQ(host.render(s).work.at("volumetrics/billboards")[int(gl::Work::shadow_lookups)], 64U);
    // A quarter of the pixels; sheets behind the wall are found empty.
    s.resolution.size = volumetrics::Resolution::half;
    s.filter.kernel = volumetrics::Filter::gaussian1;
    s.temporal.mode = volumetrics::Temporal::accumulate;
    const Frame half = host.render(s);
    EXPECT_EQ(half.work.at("volumetrics/billboards")[int(gl::Work::shadow_lookups)], 16U);
    EXPECT_THAT(half.live_passes, ElementsAre("volumetrics/depth_downsample", "volumetrics/billboards",
                                              "volumetrics/billboards_resolve", "volumetrics/temporal",
                                              "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
                                              "volumetrics/upsample"));
    host.global.clear();
    EXPECT_EQ(host.render(s).persistent_bytes, 0U);
}

}  // namespace
}  // namespace tyndall::test
