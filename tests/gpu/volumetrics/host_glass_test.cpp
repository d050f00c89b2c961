// Light of a host that has glass: coloured by what its shaders say, in every technique that asks them.

#include <gtest/gtest.h>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

class VolumetricsHostGlass : public GlTest {
  protected:
    VolumetricsHostGlass() {
        host.size = {9, 4};
        host.view_depth = [](int, int) { return 8.0F; };
        host.sun_illuminance = glm::vec3(100);
        settings.march.steps = 64;
        settings.reference.steps = 64;
        settings.froxels.x = 8;
        settings.froxels.y = 4;
    }
    [[nodiscard]] Image scattering() {
        host.volumetrics().forget_history();
        return host.render(settings).scattering;
    }
    StubHost host;
    Settings settings = plain_settings(64);
};

TEST_F(VolumetricsHostGlass, ColoursSunAndLampsAndNothingElse) {
    const glm::vec3 color(0.8F, 0.4F, 0.1F);
    // Each technique with both lights, and with both media, and each light with both media.
    bool local = false;
    for (const char* technique : {"ray_march", "froxel", "billboards", "particles", "epipolar", "reference"}) {
        settings.technique = technique;
        local = !local;
        for (const bool sun : {true, false}) {
            const bool in_local = local == sun;
            host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.3F}};
            host.local.clear();
            if (in_local)
                host.local = {{.center = {0, 0, -5}, .half_extent = glm::vec3(4), .sigma_s = glm::vec3(0.1F)}};
            host.has_sun = sun;
            host.lights.clear();
            if (!sun) host.lights = {point_light({0, 3, -5}, 100)};
            host.glass.reset();
            const Image clear = scattering();
            host.glass = color;
            const Image tinted = scattering();
            for (int c = 0; c < 3; ++c) {
                const std::string what = std::string(technique) + (sun ? " sun" : " lamp") +
                                         (in_local ? " local" : "") + " channel " + std::to_string(c);
                EXPECT_GT(clear.at(0, 1)[c], 0) << what;
                EXPECT_NEAR(tinted.at(0, 1)[c] / clear.at(0, 1)[c], color[c], 0.02) << what << " behind";
                EXPECT_NEAR(tinted.at(8, 1)[c] / clear.at(8, 1)[c], 1, 0.02) << what << " beside";
            }
        }
    }
    host.local.clear();
    host.has_sun = false;
    host.lights.clear();
    host.ambient = glm::vec3(1);
    settings.technique = "ray_march";
    const Image lit = scattering();
    host.glass.reset();
    EXPECT_EQ(lit.pixels, scattering().pixels) << "the sky's light comes through no glass";
}

TEST_F(VolumetricsHostGlass, LightThatComesThroughNoneStaysClearBesideLightThatDoes) {
    host.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.3F}};
    const glm::vec3 color(0.8F, 0.4F, 0.1F);
    const auto draw = [&](bool sun, bool lamp) {
        host.has_sun = sun;
        host.lights.clear();
        if (lamp) host.lights = {point_light({0, 3, -5}, 2000)};
        const Image image = scattering();
        return glm::vec3(image.at(0, 1)[0], image.at(0, 1)[1], image.at(0, 1)[2]);
    };
    for (const char* technique : {"ray_march", "froxel", "billboards", "epipolar", "auto"}) {
        settings.technique = technique;
        host.glass.reset();
        const glm::vec3 sun = draw(true, false), lamp = draw(false, true);
        host.glass = color;
        host.glass_of = GLASS_SUN;
        const glm::vec3 both = draw(true, true);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(lamp[c], 0.1F * sun[c]);
            EXPECT_NEAR(both[c] / (color[c] * sun[c] + lamp[c]), 1, 0.02) << technique << " channel " << c;
        }
        host.glass_of = GLASS_LAMPS;
        EXPECT_NEAR(draw(true, false)[2] / sun[2], 1, 0.02) << technique;
        EXPECT_NEAR(draw(false, true)[2] / lamp[2], color[2], 0.02) << technique;
    }
}

TEST_F(VolumetricsHostGlass, EpipolarAsksNoneOfTheRaysWhoseSunlightIsClear) {
    host.global = {{.sigma_s = glm::vec3(0.05F)}};
    host.has_sun = true;
    host.count_work = true;
    settings.technique = "epipolar";
    const auto lookups = [&](glm::vec3 glass) {
        host.glass = glass;
        return host.render(settings).work.at("volumetrics/epipolar")[int(gl::Work::shadow_lookups)];
    };
    EXPECT_EQ(lookups(glm::vec3(1)), 0U);
    EXPECT_GT(lookups({1, 1, 0.5F}), 0U);
}

TEST_F(VolumetricsHostGlass, IsNotInThePassesOfTechniquesThatDoNotAsk) {
    host.global = {{.sigma_s = glm::vec3(0.05F)}};
    host.has_sun = true;
    for (const char* technique : {"shaft_geometry", "analytic_fog", "radial_shafts"}) {
        settings.technique = technique;
        host.glass.reset();
        const Image clear = scattering();
        host.glass = glm::vec3(0.1F);
        EXPECT_EQ(clear.pixels, scattering().pixels) << technique;
    }
}

}  // namespace
}  // namespace tyndall::test
