#include "engine/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/gl/program_limits.h"
#include "support/covering_permutations.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

using Names = std::set<std::string>;

class RendererTest : public GlTest {
  protected:
    RendererTest() {
        builder_.ground({0, 0, 0}, 20);
        builder_.box({0, 1, -2}, {1, 1, 1});
    }
    void sun() { builder_.sun({-1, -2, -1}, glm::vec3(10000)); }
    void lamp(bool shadow = true) { builder_.point({2, 2, 0}, glm::vec3(200), 20, shadow); }
    void medium(Medium::Shape shape) {
        Medium m;
        m.shape = shape;
        m.sigma_s = glm::vec3(0.05f);
        builder_.scene.media.push_back(m);
    }
    void draw() {
        if (!prepared_) renderer_.prepare(builder_.finish());
        prepared_ = true;
        renderer_.render(builder_.scene, view_, size_, options_);
    }
    [[nodiscard]] Names live() const {
        const auto names = renderer_.passes().live_pass_names();
        return {names.begin(), names.end()};
    }
    [[nodiscard]] bool runs(const std::string& start) const {
        return std::ranges::any_of(live(), [&](const std::string& name) { return name.starts_with(start); });
    }
    [[nodiscard]] std::string reason(const std::string& pass) const {
        for (const PassList::PassInfo& info : renderer_.passes().passes())
            if (info.name == pass && !info.live) return info.reason;
        return "";
    }

    test::SceneBuilder builder_;
    glm::ivec2 size_{96, 64};
    View view_ = look_at({0, 2, 8}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
    FrameOptions options_;
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
    bool prepared_ = false;
};

TEST_F(RendererTest, WithoutLightSurfacesAreDrawnAtNight) {
    draw();
    EXPECT_EQ(live(), (Names{"gbuffer", "lighting", "sky/cube", "sky/irradiance", "sky/background", "tonemap"}));
    EXPECT_EQ(reason("light_cull"), "no lamp in view");
    draw();
    EXPECT_EQ(live(), (Names{"gbuffer", "lighting", "sky/background", "tonemap"}));
}

// Air, surfaces and the sky itself: 2.2e-4 to 3.2e-4 cd/m².
TEST_F(RendererTest, TheSkyOfAMoonlessNightIsSeenAndLights) {
    const int white = builder_.material(glm::vec3(1));
    builder_.scene.materials[std::size_t(white)].dielectric_f0 = 0;
    builder_.ground({0, 5, 0}, 4, white);
    options_.render.ambient = 1;
    view_ = look_at({0, 6, 0.5f}, {0, 5, 0}, 1.0f, 0.1f, 1.5f);
    draw();
    EXPECT_TRUE(renderer_.facts().has_ambient);
    EXPECT_NEAR(renderer_.read_layer().at(48, 32)[1], 2.5e-4f, 1e-5f);
    view_ = look_at({0, 6, 0}, {0, 7, -1}, 1.0f, 0.1f, 1.5f);
    draw();
    const float seen = renderer_.read_layer().at(48, 32)[1];
    EXPECT_LE(seen, 2.5e-4f);
    EXPECT_GT(seen, 1.2e-4f) << "through clouds";
}

TEST_F(RendererTest, SunBringsItsShadowsAndTheSkyAndNoClusters) {
    sun();
    draw();
    for (const char* pass : {"shadow_sun/", "sky/cube", "sky/irradiance", "sky/background"})
        EXPECT_TRUE(runs(pass)) << pass;
    for (const char* pass : {"depth_pyramid", "light_cull", "cluster", "shadow_atlas", "volumetrics"})
        EXPECT_FALSE(runs(pass)) << pass;
    draw();
    EXPECT_EQ(reason("sky/cube"), "the sun and the exposure have not changed");
    options_.render.ambient = 0;
    draw();
    EXPECT_FALSE(renderer_.facts().has_ambient);
    EXPECT_EQ(reason("sky/irradiance"), "ambient light is off");
}

TEST_F(RendererTest, LampsBringClustersAndNothingOfTheSun) {
    lamp();
    draw();
    EXPECT_EQ(live(), (Names{"gbuffer", "depth_pyramid", "light_cull", "cluster", "shadow_atlas", "lighting",
                             "sky/cube", "sky/irradiance", "sky/background", "tonemap"}));
    options_.render.occlusion_culling = false;
    options_.render.shadows = false;
    draw();
    EXPECT_EQ(live(), (Names{"gbuffer", "light_cull", "cluster", "lighting", "sky/background", "tonemap"}));
}

TEST_F(RendererTest, ALampOutOfViewCostsNothing) {
    builder_.point({0, 2, 40}, glm::vec3(100), 5);
    draw();
    EXPECT_EQ(renderer_.facts().local_lights_in_view, 0);
    EXPECT_FALSE(runs("cluster") || runs("shadow_atlas"));
}

TEST_F(RendererTest, AnUnshadowedLampNeedsNoAtlas) {
    lamp(false);
    draw();
    EXPECT_FALSE(runs("shadow_atlas"));
    EXPECT_TRUE(runs("cluster"));
}

TEST_F(RendererTest, MediaBringTheirPassesAndOnlyTheirs) {
    volumetrics_.settings.technique = "ray_march";
    sun();
    medium(Medium::Shape::global);
    draw();
    EXPECT_TRUE(runs("volumetrics/march"));
    EXPECT_FALSE(runs("volumetrics/noise_volume"));
    EXPECT_FALSE(runs("cluster"));
    medium(Medium::Shape::sphere);
    builder_.scene.media.back().noise_scale = builder_.scene.media.back().noise_amount = 1;
    draw();
    EXPECT_TRUE(runs("volumetrics/noise_volume"));
}

TEST_F(RendererTest, NoMediumIsBitIdenticalToVolumetricsOff) {
    sun();
    lamp();
    draw();
    draw();  // shadow maps and sky are drawn: what is left is a steady frame
    const Names with = live();
    const Image color = renderer_.read_layer(), shown = renderer_.read_display();
    EXPECT_EQ(volumetrics_.persistent_bytes(), 0u);
    volumetrics_.settings.technique = "off";
    medium(Medium::Shape::global);
    draw();
    EXPECT_EQ(live(), with);
    EXPECT_EQ(renderer_.read_layer().pixels, color.pixels);
    EXPECT_EQ(renderer_.read_display().pixels, shown.pixels);
}

TEST_F(RendererTest, OcclusionCullingNeverChangesThePicture) {
    for (int i = 0; i < 60; ++i) {
        const float a = static_cast<float>(i);
        builder_.box({8 * std::sin(a * 2.4f), 1, 4 - a * 0.3f}, {0.7f, 1.5f, 0.1f});
        builder_.point({7 * std::sin(a), 0.5f, 5 - a * 0.4f}, glm::vec3(20), 1.5f);
    }
    draw();
    const Image with = renderer_.read_layer();
    options_.render.occlusion_culling = false;
    draw();
    EXPECT_EQ(renderer_.read_layer().pixels, with.pixels);
    EXPECT_GT(*std::ranges::max_element(with.pixels), 1);
}

TEST_F(RendererTest, ClusterGridNeverChangesThePicture) {
    for (int i = 0; i < 40; ++i) {
        const float a = static_cast<float>(i);
        builder_.spot({7 * std::sin(a), 2, 5 - a}, {std::cos(a), -1, 0.3f}, glm::vec3(40), 6, 0.2f + 0.03f * a);
    }
    draw();
    const Image fine = renderer_.read_layer();
    options_.render.cluster_x = options_.render.cluster_y = 1;
    options_.render.cluster_z = 2;
    options_.render.cluster_far = 10;
    draw();
    EXPECT_EQ(renderer_.read_layer().pixels, fine.pixels);
}

TEST_F(RendererTest, LayersHoldWhatTheirNamesSay) {
    builder_.scene.materials[0].base_color = glm::vec4(0.25f, 0.5f, 0.75f, 1);
    sun();
    options_.layer = "albedo";
    draw();
    const int ground_x = 48, ground_y = 60;  // before the box
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(renderer_.read_layer().at(ground_x, ground_y)[c], 0.25f * static_cast<float>(c + 1), 0.005f);
    options_.layer = "normal";
    draw();
    EXPECT_NEAR(renderer_.read_layer().at(ground_x, ground_y)[1], 1, 1e-4f);
    EXPECT_EQ(renderer_.read_layer().at(2, 2)[1], 0);
    options_.layer = "depth";
    draw();
    // The pixel's point, taken back into the world, lies on the ground.
    const Image depth = renderer_.read_layer();
    EXPECT_EQ(depth.channels, 1);
    EXPECT_EQ(depth.at(2, 2)[0], 0);
    const float view_depth = depth.at(ground_x, ground_y)[0];
    const glm::vec2 ndc((ground_x + 0.5f) / 96 * 2 - 1, 1 - (ground_y + 0.5f) / 64 * 2);
    const glm::vec4 p(ndc.x / view_.projection[0][0] * view_depth, ndc.y / view_.projection[1][1] * view_depth,
                      -view_depth, 1);
    EXPECT_NEAR((glm::inverse(view_.view) * p).y, 0, 1e-3f);
    options_.layer = "transmittance";
    draw();
    EXPECT_EQ(renderer_.read_layer().at(5, 5)[0], 1);
    Medium absorbing;
    absorbing.sigma_a = glm::vec3(0.1f);
    builder_.scene.media.push_back(absorbing);
    volumetrics_.settings.filter.kernel = volumetrics::Filter::none;
    draw();
    const float distance = glm::length(glm::vec3(p));
    EXPECT_NEAR(renderer_.read_layer().at(ground_x, ground_y)[0], std::exp(-0.1f * distance), 0.003f);
    options_.layer = "scattering";
    draw();
    EXPECT_EQ(renderer_.read_layer().at(ground_x, ground_y)[0], 0);
    options_.layer = "nothing";
    EXPECT_THROW(draw(), UsageError);
}

TEST_F(RendererTest, DisplayShowsMeteredGreyAsGrey) {
    // A surface that shines at the metered mean of the scene's exposure: 0.125 * 2^EV.
    builder_.scene.materials[0].emissive = glm::vec3(0.125f * 32);
    builder_.scene.exposure_ev100 = 5;
    draw();
    EXPECT_NEAR(renderer_.read_display().at(48, 60)[1], 0.461f, 0.006f);  // sRGB of 18%
    options_.render.exposure_bias = 10;
    draw();
    EXPECT_GT(renderer_.read_display().at(48, 60)[1], 0.98f);
}

TEST_F(RendererTest, AnySizeFromOnePixelUp) {
    sun();
    lamp();
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {3, 200}, {97, 61}, {96, 64}}) {
        size_ = size;
        draw();
        EXPECT_EQ(renderer_.size(), size);
        for (const float v : renderer_.read_layer().pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0);
    }
}

TEST_F(RendererTest, TheSecondFrameIsTheFirst) {
    sun();
    lamp();
    draw();
    const Image first = renderer_.read_layer();
    draw();
    EXPECT_EQ(renderer_.read_layer().pixels, first.pixels);
    renderer_.invalidate_history();
    draw();
    EXPECT_EQ(renderer_.read_layer().pixels, first.pixels);
}

TEST_F(RendererTest, ACutForgetsHistoryAndKeepsLightVolumes) {
    sun();
    lamp();
    medium(Medium::Shape::global);
    medium(Medium::Shape::sphere);
    volumetrics_.settings.technique = "ray_march";
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::acceptance;
    options_.layer = "acceptance";
    const auto light_volumes = {"volumetrics/sun_volume", "volumetrics/lamp_volumes"};
    const auto taken = [&] {  // of earlier frames, anywhere
        const Image image = renderer_.read_layer();
        float most = 0;
        for (std::size_t i = 1; i < image.pixels.size(); i += 3) most = std::max(most, image.pixels[i]);
        return most;
    };
    draw();
    for (const char* pass : light_volumes) EXPECT_TRUE(runs(pass)) << pass;
    EXPECT_EQ(taken(), 0);
    draw();
    EXPECT_GT(taken(), 0.5f);
    renderer_.invalidate_history();
    draw();
    for (const char* pass : light_volumes)
        EXPECT_EQ(reason(pass), "neither the local media nor the light changed") << pass;
    EXPECT_EQ(taken(), 0);
}

TEST_F(RendererTest, CountsLightEvaluationsPerLamp) {
    builder_.scene.nodes.resize(1);  // the ground alone
    builder_.point({0, 1, 0}, glm::vec3(10), 1000);
    view_ = look_at({0, 5, 0.01f}, {0, 0, 0}, 1.0f, 0.1f, 1.5f);  // which fills the view
    options_.count_work = true;
    draw();
    const auto evaluations = [&] {
        for (const auto& [pass, counts] : renderer_.work())
            if (pass == "lighting") return counts[static_cast<int>(gl::Work::light_evaluations)];
        return std::uint64_t{0};
    };
    EXPECT_EQ(evaluations(), 96u * 64u);
    builder_.point({1, 1, 0}, glm::vec3(10), 1000);
    draw();
    EXPECT_EQ(evaluations(), 2u * 96u * 64u);
}

TEST_F(RendererTest, PermutationsOfTheEngineBuildWithinWhatOpenGlPromises) {
    Names seen;
    for (const ProgramDesc* desc : ProgramRegistry::all()) {
        if (desc->name.starts_with("volumetrics")) continue;  // the module has a test of its own
        seen.insert(desc->name);
        for (const Permutation& permutation : test::permutations_to_build(all_permutations(*desc))) {
            const gl::Program& program = shaders_.get(*desc, permutation);
            EXPECT_NO_THROW(gl::check_limits(desc->name, gl::program_needs(program.id()), gl::promised_limits));
        }
    }
    for (const char* name : {"gbuffer", "depth_pyramid", "light_cull", "cluster", "lighting", "sky/cube",
                             "sky/irradiance", "sky/background", "tonemap"})
        EXPECT_TRUE(seen.contains(name)) << name;
}

TEST_F(RendererTest, MirroredInstancesShowTheirOutside) {
    options_.layer = "normal";
    draw();
    const Image plain = renderer_.read_layer();
    for (Node& node : builder_.scene.nodes) {
        node.scale = glm::vec3(-1, 1, 1);
        node.world[0] *= -1.0f;
    }
    prepared_ = false;
    draw();
    const Image mirrored = renderer_.read_layer();
    for (std::size_t i = 0; i < plain.pixels.size(); ++i)
        EXPECT_NEAR(mirrored.pixels[i], plain.pixels[i], 1e-3f) << i;
}

}  // namespace
}  // namespace tyndall
