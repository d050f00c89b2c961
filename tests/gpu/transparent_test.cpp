// Alpha-blended surfaces and particles: their light, their fog, their order, and that they cost nothing where they
// are not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/files.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

class Transparent : public GlTest {
  protected:
    Transparent() {
        volumetrics_.settings.froxels.x = 16;
        volumetrics_.settings.froxels.y = 16;
        volumetrics_.settings.froxels.pixels = 0;
        volumetrics_.settings.technique = "froxel";
    }
    /// A Lambert surface, so that nothing but what a test says sends light.
    int material(glm::vec3 color, glm::vec3 emissive = glm::vec3(0)) {
        const int index = builder_.material(color, 1, 0, emissive);
        builder_.scene.materials.back().dielectric_f0 = 0;
        return index;
    }
    int glass(float alpha, glm::vec3 color, glm::vec3 emissive = glm::vec3(0)) {
        const int index = material(color, emissive);
        builder_.scene.materials.back().base_color.a = alpha;
        builder_.scene.materials.back().alpha_blend = true;
        return index;
    }
    /// Its face towards the eye has the view depth `depth`, and fills the view up to 1.2 * depth.
    void pane(float depth, int material) {
        builder_.box({0, 0, -depth - 0.01f}, {1.2f * depth, 1.2f * depth, 0.01f}, material);
    }
    ParticleEmitter& particle(float depth, glm::vec3 emission) {
        Node node;
        node.translation = {0, 0, -depth};
        node.world[3] = {0, 0, -depth, 1};
        builder_.scene.nodes.push_back(node);
        ParticleEmitter emitter;
        emitter.node = static_cast<int>(builder_.scene.nodes.size()) - 1;
        emitter.count = 1;
        emitter.lifetime = 2;
        options_.time = 1;  // half way through its life: it shows its opacity, and half of its emission
        emitter.size = 1;
        emitter.velocity = glm::vec3(0);
        emitter.spread = 0;
        emitter.color = glm::vec3(0);
        emitter.opacity = 1;
        emitter.emission = 2.0f * emission;
        builder_.scene.emitters.push_back(emitter);
        return builder_.scene.emitters.back();
    }
    void medium(Medium::Shape shape, glm::vec3 sigma_s, glm::vec3 center = glm::vec3(0)) {
        Medium m;
        m.shape = shape;
        m.sigma_s = sigma_s;
        m.sigma_a = 0.2f * sigma_s;
        m.anisotropy = 0.3f;
        m.center = center;
        m.half_extent = glm::vec3(3);
        m.height_profile = shape == Medium::Shape::height;
        m.falloff = 10;
        builder_.scene.media.push_back(m);
    }
    Image draw() {
        renderer_.prepare(builder_.finish());
        renderer_.render(builder_.scene, view_, size_, options_);
        return renderer_.read_layer();
    }
    glm::dvec3 middle() {
        const Image image = draw();
        const float* p = image.at(size_.x / 2, size_.y / 2);
        return {p[0], p[1], p[2]};
    }
    [[nodiscard]] std::string reason(const std::string& pass) const {
        for (const PassList::PassInfo& info : renderer_.passes().passes())
            if (info.name == pass && !info.live) return info.reason;
        return "";
    }
    [[nodiscard]] bool runs(const std::string& pass) const {
        return std::ranges::count(renderer_.passes().live_pass_names(), pass) > 0;
    }
    static void expect_close(glm::dvec3 value, glm::dvec3 expected, double relative, const std::string& what) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(value[c], expected[c], relative * std::abs(expected[c]) + 1e-6) << what << " channel " << c;
    }

    test::SceneBuilder builder_;
    glm::ivec2 size_{17, 17};  // the middle of a pixel is the axis
    View view_ = look_at({0, 0, 0}, {0, 0, -1}, 0.8f, 0.1f, 1);
    FrameOptions options_;
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shared_shaders(), {&volumetrics_}};
};

class TransparentFog : public Transparent {
  protected:
    /// What the eye sees of a surface of radiance `emissive` and no reflection at a depth, as an opaque one, as a
    /// pane of alpha 1 and as a particle before a far wall.
    enum class Kind { opaque, glass, particle };
    glm::dvec3 seen(Kind kind, float depth, glm::vec3 emissive) {
        builder_ = {};
        builder_.sun({0.3f, -0.5f, -1}, glm::vec3(2000, 1500, 1000));
        builder_.point({1, 0.5f, -4}, glm::vec3(300, 600, 300), 50);
        builder_.point({-2, 1, -14}, glm::vec3(3000), 60);
        medium(Medium::Shape::global, {0.01f, 0.015f, 0.02f});
        medium(Medium::Shape::height, glm::vec3(0.02f));
        medium(Medium::Shape::sphere, {0.06f, 0.05f, 0.04f}, {0, 0, -9});
        if (kind == Kind::opaque) {
            pane(depth, material(glm::vec3(0), emissive));
        } else {
            pane(90, material(glm::vec3(0)));
            if (kind == Kind::glass) pane(depth, glass(1, glm::vec3(0), emissive));
            builder_.scene.nodes.back().cast_shadow = false;  // fog is compared, not its shadow
            if (kind == Kind::particle) particle(depth, emissive);
        }
        return middle();
    }
};

TEST_F(TransparentFog, IsThatOfAnOpaqueSurfaceAtTheSameDepth) {
    for (const float depth : {1.5f, 9.0f, 20.0f, 60.0f}) {
        const glm::dvec3 scattered = seen(Kind::opaque, depth, glm::vec3(0));
        EXPECT_GT(scattered.x, 1);
        for (const Kind kind : {Kind::glass, Kind::particle})
            expect_close(seen(kind, depth, glm::vec3(0)), scattered, 0.01,
                         "scattered, depth " + std::to_string(depth) + " kind " + std::to_string(int(kind)));
        // Far more than the scattered light: what is left of it is the transmittance.
        const glm::dvec3 transmitted = seen(Kind::opaque, depth, glm::vec3(30000)) - scattered;
        for (const Kind kind : {Kind::glass, Kind::particle})
            expect_close(seen(kind, depth, glm::vec3(30000)) - scattered, transmitted, 0.01,
                         "transmitted, depth " + std::to_string(depth) + " kind " + std::to_string(int(kind)));
    }
}

TEST_F(TransparentFog, GoesOnBehindTheFroxels) {
    volumetrics_.settings.froxels.far = 10;
    const glm::dvec3 opaque = seen(Kind::opaque, 40, glm::vec3(0));
    for (const Kind kind : {Kind::glass, Kind::particle})
        expect_close(seen(kind, 40, glm::vec3(0)), opaque, 0.01, "kind " + std::to_string(int(kind)));
}

TEST_F(TransparentFog, HasClosedFormInAHomogeneousMedium) {
    // Nothing but emission e per metre and absorption: S = e / sigma (1 - exp(-sigma d)), T = exp(-sigma d). With
    // the wall's radiance W at D, a pane of alpha a and radiance E at d: S(d) + T(d) (a E + (1 - a) (S(D - d) + T(D
    // - d) W)).
    const double sigma = 0.05, e = 20, wall = 500, pane_light = 2000, a = 0.3, far = 40;
    Medium m;
    m.sigma_a = glm::vec3(sigma);
    m.emission = glm::vec3(e);
    builder_.scene.media.push_back(m);
    pane(far, material(glm::vec3(0), glm::vec3(wall)));
    pane(8, glass(float(a), glm::vec3(0), glm::vec3(pane_light)));
    const auto s = [&](double d) { return e / sigma * (1 - std::exp(-sigma * d)); };
    const auto t = [&](double d) { return std::exp(-sigma * d); };
    const double expected = s(8) + t(8) * (a * pane_light + (1 - a) * (s(far - 8) + t(far - 8) * wall));
    for (const char* technique : {"froxel", "reference"}) {
        volumetrics_.settings.technique = technique;
        expect_close(middle(), glm::dvec3(expected), 0.004, std::string("technique ") + technique);
    }
}

TEST_F(Transparent, BlendsByAlpha) {
    volumetrics_.settings.technique = "off";
    pane(20, material(glm::vec3(0), glm::vec3(100, 200, 300)));
    pane(5, glass(0.25f, glm::vec3(1), glm::vec3(800)));
    expect_close(middle(), {275, 350, 425}, 0.002, "0.25 * 800 + 0.75 * wall");
}

TEST_F(Transparent, OrderOfTheFileDoesNotMatter) {
    volumetrics_.settings.technique = "off";
    const std::vector<float> depths{3, 5, 7};
    const std::vector<glm::vec3> lights{{1000, 0, 0}, {0, 1000, 0}, {0, 0, 1000}};
    for (std::vector<int> order : {std::vector{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
        builder_ = {};
        pane(20, material(glm::vec3(0)));
        std::vector<int> materials;
        for (const int i : order) pane(depths[size_t(i)], glass(0.5f, glm::vec3(0), lights[size_t(i)]));
        expect_close(middle(), {500, 250, 125}, 0.002, "order of " + std::to_string(order[0]));
    }
    particle(4, glm::vec3(2000));  // between the first two: hides what is behind it
    expect_close(middle(), {1500, 1000, 1000}, 0.002, "particle between panes");
}

TEST_F(Transparent, HighlightsAreNotFadedByAlpha) {
    volumetrics_.settings.technique = "off";
    builder_.sun({0, 0, -1}, glm::vec3(3000));
    options_.render.ambient = 0;
    double highlight[2];
    for (const int i : {0, 1}) {
        builder_.scene.nodes.resize(1);  // the sun's
        const int black = glass(i == 0 ? 1.0f : 0.0f, glm::vec3(0));
        builder_.scene.materials[size_t(black)].dielectric_f0 = 0.04f;
        pane(20, material(glm::vec3(0)));
        pane(5, black);
        highlight[i] = middle().x;
    }
    // Roughness 1 seen and lit along the normal: f0 D / 4 = 0.04 / pi / 4.
    EXPECT_NEAR(highlight[0], 3000 * 0.04 / (4 * 3.14159265), 0.03 * highlight[0]);
    EXPECT_NEAR(highlight[1], highlight[0], 0.002 * highlight[0]);
}

TEST_F(Transparent, AtAlphaOneIsLitAndShadowedAsAnOpaqueSurface) {
    size_ = {48, 48};
    view_ = look_at({0, 5, 7}, {0, 0, 0}, 1, 0.1f, 1);
    volumetrics_.settings.technique = "off";
    const auto picture = [&](bool blend) {
        builder_ = {};
        builder_.sun({-1, -2, -1}, glm::vec3(4000));
        builder_.point({2, 2, 0}, glm::vec3(900), 20, true);
        builder_.spot({-2, 4, 2}, {0.2f, -1, -0.3f}, glm::vec3(900), 20, 0.6f, true);
        // What 8 bits hold exactly: the G-buffer has the sRGB codes 188, 128 and 100, and 102 of 255 for the
        // roughness.
        const int floor = builder_.material({0.50289f, 0.21586f, 0.12744f}, 0.4f);
        builder_.scene.materials.back().alpha_blend = blend;
        builder_.ground({0, 0, 0}, 6, floor);
        builder_.box({0, 1, -1}, {0.7f, 1, 0.7f});
        return draw();
    };
    const Image opaque = picture(false), blended = picture(true);
    int differing = 0;
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x)
            for (int c = 0; c < 3; ++c)
                differing += std::abs(blended.at(x, y)[c] - opaque.at(x, y)[c]) > 0.01f * opaque.at(x, y)[c] + 0.1f;
    EXPECT_LE(differing, 3 * 4) << "of " << size_.x * size_.y << " pixels and channels";
    EXPECT_TRUE(runs("transparent"));
}

TEST_F(Transparent, SmokeIsAFunctionOfTime) {
    builder_.sun({-1, -2, -1}, glm::vec3(4000));
    pane(20, material(glm::vec3(0.5f)));
    ParticleEmitter& smoke = particle(6, glm::vec3(0));
    smoke.count = 20;
    smoke.spread = 0.5f;
    smoke.color = glm::vec3(0.7f);
    options_.time = 3.3;
    const Image first = draw();
    options_.time = 4.1;
    const Image later = draw();
    EXPECT_NE(later.pixels, first.pixels);
    options_.time = 3.3;
    EXPECT_EQ(draw().pixels, first.pixels);
}

TEST_F(Transparent, LitParticlesScatterAlikeInAllDirections) {
    // The sun's E / (4 pi) times the colour, where the particle is opaque; half of it in a shadow's place: none.
    volumetrics_.settings.technique = "off";
    options_.render.ambient = 0;
    builder_.sun({0, -1, 0}, glm::vec3(5000));
    pane(20, material(glm::vec3(0)));
    particle(5, glm::vec3(0)).color = {1, 0.5f, 0.25f};
    const double whole = 5000 / (4 * 3.14159265);
    expect_close(middle(), glm::dvec3(1, 0.5, 0.25) * whole, 0.005, "in the sun");
    builder_.box({0, 6, -5}, {3, 0.1f, 3});
    expect_close(middle(), glm::dvec3(0), 0, "under a roof");
}

TEST_F(Transparent, NothingTransparentNoPass) {
    medium(Medium::Shape::global, glm::vec3(0.02f));
    pane(20, material(glm::vec3(0.5f)));
    volumetrics_.settings.technique = "ray_march";
    draw();
    EXPECT_FALSE(runs("transparent"));
    EXPECT_EQ(reason("transparent"), "nothing transparent in view");
    EXPECT_FALSE(runs("volumetrics/froxel_light"));
    builder_.box({0, 0, 30}, {1, 1, 1}, glass(0.5f, glm::vec3(1)));  // behind the eye
    draw();
    EXPECT_FALSE(runs("transparent"));
    EXPECT_FALSE(runs("volumetrics/froxel_light"));
    pane(5, glass(0.5f, glm::vec3(1)));
    draw();
    for (const char* pass : {"transparent", "volumetrics/froxel_light", "volumetrics/march"})
        EXPECT_TRUE(runs(pass));
    volumetrics_.settings.technique = "off";
    draw();
    EXPECT_TRUE(runs("transparent"));
    EXPECT_FALSE(runs("volumetrics/froxel_light"));
}

TEST_F(Transparent, NoHighlightLeavesTheRangeOfHalfFloats) {
    builder_.sun({0, 0, -1}, glm::vec3(1e8f));
    for (const float depth : {2.0f, 3.0f, 4.0f, 5.0f}) {
        const int mirror = glass(0.1f, glm::vec3(1), glm::vec3(1e6f));
        builder_.scene.materials[size_t(mirror)].dielectric_f0 = 0.2f;
        builder_.scene.materials[size_t(mirror)].roughness = 0;
        builder_.scene.materials[size_t(mirror)].double_sided = true;
        pane(depth, mirror);
    }
    particle(2.5f, glm::vec3(1e6f));
    medium(Medium::Shape::global, glm::vec3(0.1f));
    for (const float value : draw().pixels) {
        ASSERT_TRUE(std::isfinite(value));
        EXPECT_LE(value, 65504);
        EXPECT_GE(value, 0);
    }
}

}  // namespace
}  // namespace tyndall
