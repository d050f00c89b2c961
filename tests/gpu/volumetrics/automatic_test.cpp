// Technique auto: each light by the estimator that suits it, against the technique reference.

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::Contains;
using ::testing::Not;

class VolumetricsAutomatic : public GlTest {
  protected:
    StubHost host;
    Settings settings = plain_settings(4);

    void SetUp() override {
        settings.march.max_distance = 60;
        settings.reference.steps = 512;
        settings.froxels.x = 32;
        settings.froxels.y = 18;
        settings.froxels.z = 48;
        settings.froxels.far = 60;
        settings.froxels.distribution = volumetrics::DepthDistribution::automatic;
        settings.automatic.lamps = 0;
        host.size = {96, 54};
        host.global = {{.sigma_s = glm::vec3(0.03F), .sigma_a = glm::vec3(0.005F), .anisotropy = 0.3F}};
        host.view_depth = [](int, int) { return 40.0F; };
    }

    /// Lamps that stand between the centres of froxels and in them, near and far; one is a spot.
    void add_lamps() {
        host.lights = {point_light({0.31F, 0.12F, -6}, 100), point_light({-2.4F, 1.1F, -12}, 100),
                       point_light({4.1F, -1.9F, -25}, 300, 30), point_light({-1.3F, -0.7F, -4}, 20, 10, 0.05F),
                       spot_light({1.5F, 1.8F, -9}, {0, -1, 0}, 200, 0.9F, 0.7F)};
    }

    [[nodiscard]] Frame render(const std::string& technique) {
        settings.technique = technique;
        return host.render(settings);
    }
    /// Root mean square difference from the reference over its mean.
    [[nodiscard]] double error(const std::string& technique) {
        const Frame truth = render("reference"), found = render(technique);
        double squares = 0, sum = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double value = found.scattering.at(x, y)[0], expected = truth.scattering.at(x, y)[0];
                EXPECT_TRUE(std::isfinite(value) && value >= 0) << x << ' ' << y;
                squares += (value - expected) * (value - expected);
                sum += expected;
            }
        const double pixels = host.size.x * host.size.y;
        return std::sqrt(squares / pixels) / (sum / pixels);
    }
};

// Froxels are three pixels wide: what lies between their centres near a lamp they cannot hold, pixels can.
TEST_F(VolumetricsAutomatic, FroxelsLeaveTheCoresOfLampsToPixels) {
    add_lamps();
    const double automatic = error("auto"), froxel = error("froxel");
    std::printf("relative RMSE: auto %.4f, froxel %.4f\n", automatic, froxel);
    EXPECT_LT(automatic, 0.03);
    EXPECT_GT(froxel, 3 * automatic);
}

TEST_F(VolumetricsAutomatic, CoresKnowHeight) {
    add_lamps();
    host.global.push_back({.sigma_s = glm::vec3(0.05F), .height = true, .base = -1, .falloff = 2});
    const double automatic = error("auto");
    std::printf("relative RMSE: %.4f\n", automatic);
    EXPECT_LT(automatic, 0.03);
}

TEST_F(VolumetricsAutomatic, CoresKnowLocalMedia) {
    add_lamps();
    host.local = {
        {.center = {0, 0, -6}, .half_extent = glm::vec3(3), .sigma_s = glm::vec3(0.1F), .anisotropy = 0.5F}};
    settings.froxels.z = 128;
    const double automatic = error("auto");
    std::printf("relative RMSE: %.4f\n", automatic);
    EXPECT_LT(automatic, 0.06);
}

// Each lamp is taken once, by whichever way.
TEST_F(VolumetricsAutomatic, LampsByPixelAndInFroxelsAddUp) {
    add_lamps();
    settings.automatic.least_lamp = 0;
    for (const int lamps : {1, 3, 5}) {
        settings.automatic.lamps = lamps;
        EXPECT_LT(error("auto"), 0.03) << lamps;
    }
}

// What dominates is sharp: shadows of a fence, with lines as fine as those of the technique epipolar.
TEST_F(VolumetricsAutomatic, ALampThatOutshinesOthersHasSharpShadows) {
    add_lamps();
    host.shadows = 1;
    for (shared::GpuLight& light : host.lights) light.cone_shadow.z = 1;
    host.lights[0].intensity_radius *= glm::vec4(100, 100, 100, 1);
    settings.automatic.lamps = 4;
    settings.epipolar.lamp_spacing = 0.25F;
    settings.epipolar.lamp_rays = 1024;
    const double sharp = error("auto"), lines = error("epipolar"), froxel = error("froxel");
    std::printf("relative RMSE: auto %.4f, epipolar %.4f, froxel %.4f\n", sharp, lines, froxel);
    EXPECT_LT(sharp, lines + 0.01);
    EXPECT_GT(froxel, 2 * sharp);
}

TEST_F(VolumetricsAutomatic, WhatNoLampNeedsIsNotDone) {
    host.has_sun = true;
    Frame frame = render("auto");
    EXPECT_THAT(frame.live_passes, Contains("volumetrics/epipolar"));
    for (const char* pass : {"volumetrics/many_lamps_light", "volumetrics/many_lamps", "volumetrics/lamp_cores"})
        EXPECT_THAT(frame.live_passes, Not(Contains(pass))) << pass;
    add_lamps();
    frame = render("auto");
    for (const char* pass : {"volumetrics/many_lamps_light", "volumetrics/many_lamps", "volumetrics/lamp_cores"})
        EXPECT_THAT(frame.live_passes, Contains(pass)) << pass;
    settings.automatic.lamps = 5;
    settings.automatic.least_lamp = 0;
    frame = render("auto");
    EXPECT_EQ(frame.skipped.at("volumetrics/many_lamps"), "pixels take all lamps one by one");
}

TEST_F(VolumetricsAutomatic, WithoutShadowMapsFroxelsTakeAllLights) {
    host.has_shadow_maps = false;
    host.has_sun = true;
    add_lamps();
    const Frame automatic = render("auto"), froxel = render("froxel");
    EXPECT_EQ(automatic.scattering.pixels, froxel.scattering.pixels);
    EXPECT_THAT(automatic.skipped.at("volumetrics/epipolar"), ::testing::HasSubstr("shadow_maps.glsl"));
}

// The suns of a picture with many lamps are those of the technique epipolar.
TEST_F(VolumetricsAutomatic, SunAndAmbientLightAreCountedOnce) {
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(5);
    host.ambient = glm::vec3(0.4F);
    host.shadows = 3;
    add_lamps();
    for (shared::GpuLight& light : host.lights) light.cone_shadow.z = -1;  // no shadow
    EXPECT_LT(error("auto"), 0.03);
}

}  // namespace
}  // namespace tyndall::test
