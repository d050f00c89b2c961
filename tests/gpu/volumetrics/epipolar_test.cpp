// Technique epipolar: trees over what light meets first, against the technique reference, which asks for single
// points.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::Resolution;

class VolumetricsEpipolar : public GlTest {
  protected:
    StubHost host;
    Settings settings = plain_settings(2);

    void SetUp() override {
        settings.technique = "epipolar";
        settings.march.max_distance = 60;
        settings.epipolar.spacing = settings.epipolar.lamp_spacing = 0.25F;
        settings.epipolar.lamp_rays = 1024;
        host.size = {48, 27};
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.2F));
        host.sun_illuminance = glm::vec3(10);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.4F}};
        host.view_depth = [](int x, int y) { return 6.0F + static_cast<float>((x + y) % 30); };
    }

    [[nodiscard]] Frame render(const std::string& technique) {
        settings.technique = technique;
        settings.reference.steps = 512;
        return host.render(settings);
    }
    /// Root mean square difference from the reference over its mean.
    [[nodiscard]] double error() {
        const Frame reference = render("reference"), found = render("epipolar");
        double squares = 0, sum = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double value = found.scattering.at(x, y)[0], truth = reference.scattering.at(x, y)[0];
                EXPECT_TRUE(std::isfinite(value) && value >= 0) << x << ' ' << y;
                squares += (value - truth) * (value - truth);
                sum += truth;
                EXPECT_NEAR(found.transmittance.at(x, y)[0], reference.transmittance.at(x, y)[0], 2e-3);
            }
        const double pixels = host.size.x * host.size.y;
        return std::sqrt(squares / pixels) / (sum / pixels);
    }
    [[nodiscard]] double a_ray(gl::Work work) {
        host.count_work = true;
        settings.technique = "epipolar";
        const auto counts = host.render(settings).work;
        host.count_work = false;
        return static_cast<double>(counts.at("volumetrics/epipolar")[int(work)]) / (host.size.x * host.size.y);
    }
    [[nodiscard]] double nodes_a_ray() { return a_ray(gl::Work::tree_nodes); }
};

// On the screen, on its border, beside it, behind the eye; the same for what travels the other way.
TEST_F(VolumetricsEpipolar, TheSunMayStandAnywhere) {
    host.shadows = 3;
    host.eye = {0.3F, 0, 0};
    for (const glm::vec3 to_sun :
         {glm::vec3(0.1F, 0.2F, -1), glm::vec3(0.55F, 0.56F, -1), glm::vec3(1, 0.6F, -0.4F),
          glm::vec3(0.3F, 0.3F, 1), glm::vec3(-0.2F, 1, 0.1F), glm::vec3(0.01F, 0.05F, 1)}) {
        host.sun_direction = -glm::normalize(to_sun);
        EXPECT_LT(error(), 0.01) << to_sun.x << ' ' << to_sun.y << ' ' << to_sun.z;
    }
}

TEST_F(VolumetricsEpipolar, ShaftsOfAFenceConvergeWithTheCells) {
    host.shadows = 1;
    std::vector<double> errors;
    for (const int cells : {128, 512, 2048}) {
        settings.epipolar.cells = cells;
        errors.push_back(error());
        std::printf("%d cells: %.4f\n", cells, errors.back());
    }
    EXPECT_LT(errors[1], 0.5 * errors[0]);
    EXPECT_LT(errors[2], 0.01);
}

TEST_F(VolumetricsEpipolar, UnshadowedItIsTheClosedForm) {
    host.shadows = 0;
    host.lights = {point_light({1, 1, -5}, 20, 30), spot_light({-2, 3, -8}, {0.2F, -1, 0}, 30, 0.9F, 0.7F, 30)};
    for (shared::GpuLight& light : host.lights) light.cone_shadow.z = 0;
    const Frame found = render("epipolar");
    EXPECT_LE(nodes_a_ray(), 2 * 3.0) << "one node for each light and part";
    settings.march.steps = 64;
    const Frame march = render("ray_march");
    for (int y = 0; y < host.size.y; ++y)
        for (int x = 0; x < host.size.x; ++x)
            EXPECT_NEAR(found.scattering.at(x, y)[0], march.scattering.at(x, y)[0],
                        2e-3 * march.scattering.at(x, y)[0]);
}

TEST_F(VolumetricsEpipolar, ASunWithoutAShadowHasNoLines) {
    host.shadows = 0;
    const Frame asked = render("epipolar");
    host.sun_shadow = false;
    for (const int step : {1, 8}) {
        settings.epipolar.step = step;
        const Frame found = render("epipolar");
        EXPECT_EQ(found.skipped.at("volumetrics/epipolar_lines"), "no light in view that casts shadows");
        EXPECT_EQ(found.scattering.pixels, asked.scattering.pixels) << step;
    }
}

// With more steps allowed than any ray needs: one of a ray in one medium or along a layer, and few where it leaves
// haze for fog.
TEST_F(VolumetricsEpipolar, TakesAsManyStepsAsMediaNeed) {
    settings.march.steps = 64;
    host.shadows = 3;
    EXPECT_EQ(a_ray(gl::Work::medium_samples), 1) << "homogeneous";
    EXPECT_LT(error(), 0.01);
    host.global.push_back(
        {.sigma_s = glm::vec3(0.2F), .sigma_a = glm::vec3(0.1F), .height = true, .base = -1, .falloff = 1.5F});
    const double mixed = a_ray(gl::Work::medium_samples);
    EXPECT_GT(mixed, 1.5);
    EXPECT_LT(mixed, 32);
    EXPECT_LT(error(), 0.01);
    settings.march.steps = 1;
    EXPECT_GT(error(), 0.02) << "it was no more than needed";
}

TEST_F(VolumetricsEpipolar, WhatOneMediumSendsAndAnotherAbsorbsTakesSteps) {
    settings.march.steps = 64;
    host.shadows = 3;
    const auto mist = [](float sigma_a, float emission) {
        return GlobalMedium{.sigma_a = glm::vec3(sigma_a),
                            .emission = glm::vec3(emission),
                            .height = true,
                            .base = -1,
                            .falloff = 1.5F};
    };
    host.global = {{.sigma_s = glm::vec3(0.05F)}, mist(0.3F, 0)};
    EXPECT_LT(error(), 0.01) << "it scatters in mist that absorbs";
    host.global = {{.sigma_a = glm::vec3(0.2F)}, mist(0, 0.1F)};
    EXPECT_LT(error(), 0.01) << "mist that shines in air that absorbs";
}

TEST_F(VolumetricsEpipolar, RaysAlongTheSunlightAreLit) {
    host.shadows = 0;
    host.size = {1, 1};
    for (const float z : {-1.0F, 1.0F}) {
        host.sun_direction = {0, 0, z};
        const float march = render("ray_march").scattering.at(0, 0)[0];
        EXPECT_NEAR(render("epipolar").scattering.at(0, 0)[0], march, 1e-3F * march) << z;
    }
}

// In the picture, beside it, behind the eye, before and behind the wall; a spot with the eye in its cone and out of
// it.
TEST_F(VolumetricsEpipolar, LampsBehindAWall) {
    host.shadows = 2;
    host.has_sun = false;
    settings.march.steps = 8;
    for (const shared::GpuLight light :
         {point_light({0.5F, 1, -10}, 20, 40), point_light({-6, 1, -9}, 20, 40), point_light({1, 0.5F, 3}, 20, 40),
          point_light({0, 0.2F, -5}, 20, 40), spot_light({1, 2, -12}, {-0.1F, -0.1F, 1}, 50, 0.95F, 0.8F, 40),
          spot_light({2, 5, -9}, {0, -1, 0.3F}, 50, 0.9F, 0.7F, 40)}) {
        host.lights = {light};
        // At 8 steps the rim of a cone is a few percent off, as the march's: its law has a kink.
        EXPECT_LT(error(), light.direction_type.w == LIGHT_SPOT ? 0.035 : 0.01)
            << light.position_range.x << " " << light.position_range.z;
    }
}

// A lamp's rule is exact enough for a whole ray in thin air, and where it is not the ray is cut: in the sphere
// where the inverse square is cut off, in thick media and for peaks of the phase function.
TEST_F(VolumetricsEpipolar, ALampTakesAsFewPartsAsItsLightNeeds) {
    host.shadows = 2;
    host.has_sun = false;
    settings.march.steps = 8;
    const auto lamp = [](float radius) { return point_light({0.5F, 1, -10}, 20, 40, radius); };
    host.lights = {lamp(0.01F)};
    for (const float g : {0.0F, 0.4F, 0.85F}) {
        host.global = {{.sigma_s = glm::vec3(0.03F), .anisotropy = g}};
        const double parts = a_ray(gl::Work::light_evaluations);
        EXPECT_GE(parts, 1);
        EXPECT_LE(parts, g == 0 ? 1.0 : g < 0.5F ? 1.8 : 5.5);
        EXPECT_LT(error(), g < 0.5F ? 0.01 : 0.03) << g;
    }
    for (const float radius : {1.0F, 3.0F}) {
        host.lights = {lamp(radius)};
        host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.4F}};
        EXPECT_LT(error(), 0.01) << radius;
        host.global = {{.sigma_s = glm::vec3(0.3F), .anisotropy = 0.4F}};
        EXPECT_LT(error(), 0.015) << radius << ", thick";
    }
}

TEST_F(VolumetricsEpipolar, ALampAtTheEyeSeesWhatTheEyeSees) {
    host.shadows = 2;
    host.has_sun = false;
    host.eye = {0, 0, 0};
    host.view_depth = [](int, int) { return 5.0F; };  // before the wall
    settings.march.steps = 8;
    for (const float away : {0.0F, 0.001F, 0.05F}) {
        host.lights = {point_light({away, 0, 0}, 20, 40, 0.1F)};
        EXPECT_LT(error(), 0.02) << away;
    }
}

TEST_F(VolumetricsEpipolar, HeightMediaAndColouredExtinction) {
    host.shadows = 3;
    host.global = {{.sigma_s = glm::vec3(0.05F, 0.08F, 0.1F),
                    .sigma_a = glm::vec3(0.02F, 0.01F, 0),
                    .anisotropy = 0.4F,
                    .height = true,
                    .base = -2,
                    .falloff = 4},
                   {.sigma_s = glm::vec3(0.01F, 0.02F, 0.04F), .rayleigh = true}};
    settings.march.steps = 8;
    EXPECT_LT(error(), 0.01);
}

TEST_F(VolumetricsEpipolar, LocalMediaHaveTheirOwnShares) {
    host.shadows = 3;
    host.global = {};
    host.local = {
        {.center = {0, 0, -5}, .half_extent = glm::vec3(3), .sigma_s = glm::vec3(0.2F), .anisotropy = 0.2F},
        {.shape = Shape::box, .center = {2, 1, -12}, .half_extent = {1, 3, 2}, .sigma_s = glm::vec3(0.4F)}};
    settings.march.steps = 8;
    EXPECT_LT(error(), 0.03);
}

TEST_F(VolumetricsEpipolar, ARayWithOneEdgeReadsFewNodes) {
    host.shadows = 3;
    settings.march.steps = 1;
    for (const int cells : {256, 1024, 2048}) {
        settings.epipolar.cells = cells;
        EXPECT_LE(nodes_a_ray(), 40) << cells;
        EXPECT_GE(nodes_a_ray(), 1);
    }
}

TEST_F(VolumetricsEpipolar, PanningMovesNothingButTheCamera) {
    host.shadows = 1;
    host.size = {64, 36};
    // The mean of what the picture gathers differs from the reference's by the same little, frame after frame.
    double before = 0;
    for (int frame = 0; frame < 12; ++frame) {
        const auto angle = static_cast<float>(glm::radians(-20.0 + 4 * frame));
        host.rotation = glm::mat3(glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)));
        const Frame reference = render("reference"), found = render("epipolar");
        double difference = 0, sum = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                difference += found.scattering.at(x, y)[0] - reference.scattering.at(x, y)[0];
                sum += reference.scattering.at(x, y)[0];
            }
        if (frame > 0) {
            EXPECT_NEAR(difference / sum, before, 0.005) << frame;
        }
        before = difference / sum;
    }
}

TEST_F(VolumetricsEpipolar, SmallAndLongPictures) {
    host.shadows = 3;
    host.eye = {3, 0, 0};  // the middle ray is lit
    host.view_depth = [](int, int) { return 10.0F; };
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(1024, 4)}) {
        host.size = size;
        EXPECT_LT(error(), 0.03) << size.x << 'x' << size.y;
    }
    host.size = {48, 27};
    host.view_depth = [](int, int) { return sky; };
    EXPECT_LT(error(), 0.02) << "all sky";
}

TEST_F(VolumetricsEpipolar, AHostWithoutShadowMapsIsTold) {
    host.has_shadow_maps = false;
    const Frame frame = render("epipolar");
    EXPECT_TRUE(frame.live_passes.empty());
    EXPECT_EQ(frame.skipped.at("volumetrics/epipolar"), "the host has no shaders/interface/shadow_maps.glsl");
}

}  // namespace
}  // namespace tyndall::test
