// Light through transparent surfaces: (1 - alpha) + alpha transmission base_color of it is left behind each, on
// surfaces and in the air, for every kind of light; and glass costs nothing where there is none.

#include "engine/render/glass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapter/volumetrics_adapter.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

enum class Lit { sun, second_sun, point, spot };
constexpr Lit lights[] = {Lit::sun, Lit::second_sun, Lit::point, Lit::spot};

class Glass : public GlTest {
  protected:
    Glass() {
        options_.render.ambient = 0;
        volumetrics_.settings.noise.kind = volumetrics::Noise::none;
        volumetrics_.settings.filter.kernel = volumetrics::Filter::none;
        volumetrics_.settings.temporal.mode = volumetrics::Temporal::off;
    }

    int lambert(glm::vec3 color, glm::vec3 emissive = glm::vec3(0)) {
        const int index = builder_.material(color, 1, 0, emissive);
        builder_.scene.materials.back().dielectric_f0 = 0;
        return index;
    }
    int glass(glm::vec3 color, float alpha = 1, float transmission = 1) {
        const int index = lambert(color);
        Material& material = builder_.scene.materials.back();
        material.base_color.a = alpha;
        material.alpha_blend = true;
        material.transmission = transmission;
        return index;
    }
    /// A wall in the plane z = -1 that the light shines on from above and from the side of the eye, and level
    /// sheets of glass at the heights given, before its half x < 0: they colour what of the wall is below them.
    void wall(Lit kind, const std::vector<float>& sheets, const std::vector<int>& glass) {
        const glm::vec3 forward = glm::normalize(glm::vec3(0, -1, -0.7f)), place(0, 6, 4);
        if (kind == Lit::sun) builder_.sun(forward, glm::vec3(4000));
        if (kind == Lit::second_sun) {
            builder_.sun({0, -1, 1}, glm::vec3(9000));  // onto the wall's back
            builder_.sun(forward, glm::vec3(4000));
        }
        if (kind == Lit::point) builder_.point(place, glm::vec3(9e4f), 40, true);
        if (kind == Lit::spot) builder_.spot(place, {0, -0.8f, -1}, glm::vec3(9e4f), 40, 0.9f, true);
        builder_.box({0, 2, -1.1f}, {4, 4, 0.1f}, lambert(glm::vec3(0.8f)));
        for (std::size_t i = 0; i < sheets.size(); ++i) builder_.ground({-1.5f, sheets[i], 0.6f}, 1.5f, glass[i]);
    }
    Image draw(const std::string& layer = "color") {
        options_.layer = layer;
        renderer_.prepare(builder_.finish());
        if (options_.frame_index == 0) renderer_.invalidate_history();
        renderer_.render(builder_.scene, view_, size_, options_);
        return renderer_.read_layer();
    }
    [[nodiscard]] glm::dvec3 at(const Image& image, glm::vec3 world) const {
        const glm::vec4 clip = view_.view_projection * glm::vec4(world, 1);
        const glm::vec2 place = (0.5f + 0.5f * glm::vec2(clip) / clip.w) * glm::vec2(size_);
        const float* p = image.at(static_cast<int>(place.x), size_.y - 1 - static_cast<int>(place.y));
        return {p[0], p[1], p[2]};
    }
    static void expect_near(glm::dvec3 value, glm::dvec3 expected, double tolerance, const std::string& what) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << what << " channel " << c;
    }
    [[nodiscard]] std::string reason(const std::string& pass) const {
        for (const PassList::PassInfo& info : renderer_.passes().passes())
            if (info.name == pass && !info.live) return info.reason;
        return "";
    }

    test::SceneBuilder builder_;
    glm::ivec2 size_{96, 64};
    /// Backs of level sheets are not drawn: from below none is seen.
    View view_ = look_at({0, 1.2f, 9}, {0, 1.5f, 0}, 0.6f, 0.1f, 1.5f);
    FrameOptions options_;
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shared_shaders(), {&volumetrics_}};
};

TEST_F(Glass, ColoursSurfacesBehindItAndNoOthers) {
    struct Sheet {
        glm::vec3 color;
        float alpha, transmission;
    };
    for (const Lit kind : lights)
        for (const Sheet& s :
             {Sheet{{0.9f, 0.2f, 0.1f}, 1, 1}, {{0.1f, 0.4f, 0.8f}, 0.6f, 0.5f}, {{1, 0, 0}, 0.7f, 0}}) {
            builder_ = {};
            wall(kind, {}, {});
            const Image clear = draw();
            builder_ = {};
            wall(kind, {1.8f}, {glass(s.color, s.alpha, s.transmission)});
            const Image tinted = draw();
            const auto share = [&](glm::vec3 place) { return at(tinted, place) / at(clear, place); };
            const glm::dvec3 filter =
                1.0 - double(s.alpha) + double(s.alpha * s.transmission) * glm::dvec3(s.color);
            const std::string what = "light " + std::to_string(int(kind)) + " alpha " + std::to_string(s.alpha);
            expect_near(share({-1, 0.6f, -1}), filter, 0.002, what + " behind");
            expect_near(share({1, 0.6f, -1}), glm::dvec3(1), 1e-3, what + " beside");
            expect_near(share({-1, 2.8f, -1}), glm::dvec3(1), 1e-3, what + " before");
        }
}

TEST_F(Glass, SheetsMultiplyAndFilterAsOneBehindTheFirst) {
    for (const Lit kind : lights) {
        builder_ = {};
        wall(kind, {}, {});
        const Image clear = draw();
        builder_ = {};
        const glm::vec3 red(0.9f, 0.5f, 0.3f), blue(0.2f, 0.6f, 0.9f);
        wall(kind, {2.2f, 1.4f}, {glass(red), glass(blue)});
        const Image tinted = draw();
        const auto share = [&](float y) { return at(tinted, {-1, y, -1}) / at(clear, {-1, y, -1}); };
        const std::string what = "light " + std::to_string(int(kind));
        expect_near(share(2.9f), glm::dvec3(1), 1e-3, what + " before both");
        expect_near(share(1.8f), red, 0.002, what + " between them, where the light ends");
        expect_near(share(0.2f), red * blue, 0.002, what + " behind both");
    }
}

/// The part of a ray in the shadow of a wall is behind the glass that the wall hides.
TEST_F(Glass, BehindAWallDoesNotCount) {
    builder_.sun({0, -1, -0.7f}, glm::vec3(4000));
    builder_.box({0, 2, -1.1f}, {4, 4, 0.1f}, lambert(glm::vec3(0.8f)));
    builder_.ground({0, 0, -4}, 2.5f, glass({0, 1, 0}));  // under the wall's foot, as the light goes
    builder_.ground({-1.5f, 1.8f, 0.6f}, 1.5f, glass({1, 0.5f, 0.2f}));
    const glm::dvec3 found = at(draw(), {-1, 0.6f, -1});
    expect_near(found / found.r, {1, 0.5, 0.2}, 0.002, "wall");
}

/// S(0, d) + T(0, d) filter (S + T W): the fog before the glass is not filtered, that behind it is.
TEST_F(Glass, FiltersWhatIsSeenThroughIt) {
    const double sigma = 0.05, e = 20, wall = 500, far = 40, near = 8;
    Medium m;
    m.sigma_a = glm::vec3(sigma);
    m.emission = glm::vec3(e);
    builder_.scene.media.push_back(m);
    view_ = look_at({0, 0, 0}, {0, 0, -1}, 0.8f, 0.1f, 1);
    size_ = {17, 17};
    const glm::vec3 color(0.9f, 0.4f, 0.1f);
    builder_.box({0, 0, -far - 0.01}, {50, 50, 0.01f}, lambert(glm::vec3(0), glm::vec3(wall)));
    builder_.box({0, 0, -near - 0.01}, {12, 12, 0.01f}, glass(color, 0.8f));
    const auto s = [&](double d) { return e / sigma * (1 - std::exp(-sigma * d)); };
    const auto t = [&](double d) { return std::exp(-sigma * d); };
    const glm::dvec3 filter = 0.2 + 0.8 * glm::dvec3(color);
    const glm::dvec3 expected = s(near) + t(near) * filter * (s(far - near) + t(far - near) * wall);
    const float* p = draw().at(8, 8);
    expect_near(glm::dvec3(p[0], p[1], p[2]) / expected, glm::dvec3(1), 0.004, "radiance");
}

class GlassInAir : public Glass {
  protected:
    void SetUp() override {
        Glass::SetUp();
        view_ = look_at({0, 1.2f, 9}, {0, 1.2f, 0}, 0.4f, 0.1f, 1.5f);
        volumetrics_.settings.march.steps = 16;
        volumetrics_.settings.march.max_distance = 60;
        volumetrics_.settings.froxels.x = 24;
        volumetrics_.settings.froxels.y = 16;
        volumetrics_.settings.froxels.pixels = 0;
        volumetrics_.settings.reference.steps = 64;
    }
    /// Air under a light, and between them a level sheet over all that is in view, or over its left half.
    void air(Lit kind, int sheet_material, float right_edge = 50) {
        const glm::vec3 down(0, -1, 0);
        if (kind == Lit::sun) builder_.sun(down, glm::vec3(4000));
        if (kind == Lit::point) builder_.point({0, 8, -2}, glm::vec3(9e4f), 60, true);
        if (kind == Lit::spot) builder_.spot({0, 8, -2}, down, glm::vec3(9e4f), 60, 1.3f, true);
        builder_.box({0, 0, -20}, {20, 20, 0.5f}, lambert(glm::vec3(0.5f)));
        if (sheet_material >= 0) builder_.ground({right_edge - 60, 6, 0}, 60, sheet_material);
        Medium m;
        m.sigma_s = glm::vec3(0.03f);
        m.anisotropy = 0.2f;
        builder_.scene.media.push_back(m);
    }
    static glm::dvec3 pixel(const Image& image, double x) {
        const float* p = image.at(static_cast<int>(x * image.size.x), image.size.y / 2);
        return {p[0], p[1], p[2]};
    }
};

constexpr glm::vec3 tint(0.9f, 0.3f, 0.1f);

TEST_F(GlassInAir, ColoursLightThatEachTechniqueScatters) {
    for (const char* technique : {"ray_march", "froxel", "billboards", "particles", "reference", "epipolar"}) {
        volumetrics_.settings.technique = technique;
        for (const Lit kind : {Lit::sun, Lit::point, Lit::spot}) {
            builder_ = {};
            air(kind, -1);
            const Image clear = draw("scattering");
            builder_ = {};
            air(kind, glass(tint));
            const Image tinted = draw("scattering");
            builder_ = {};
            air(kind, glass(tint), -1.5f);
            const Image beside = draw("scattering");
            const std::string what = std::string(technique) + " light " + std::to_string(int(kind));
            EXPECT_GT(pixel(clear, 0.5).r, 0) << what;
            expect_near(pixel(tinted, 0.5) / pixel(clear, 0.5), tint, 0.002, what + " behind");
            expect_near(pixel(beside, 0.8) / pixel(clear, 0.8), glm::dvec3(1), 0.002, what + " beside");
        }
    }
}

/// A further sun is a lamp that a march lights by its tile.
TEST_F(GlassInAir, ColoursLightOfFurtherSuns) {
    volumetrics_.settings.technique = "ray_march";
    builder_.sun({0, 1, 0.01f}, glm::vec3(5000));  // from below, through the floor: dark
    builder_.sun({0, -1, 0}, glm::vec3(4000));
    builder_.box({0, -3, 0}, {60, 0.5f, 60}, lambert(glm::vec3(0.5f)));
    builder_.box({0, 0, -20}, {20, 20, 0.5f}, lambert(glm::vec3(0.5f)));
    Medium m;
    m.sigma_s = glm::vec3(0.03f);
    builder_.scene.media.push_back(m);
    const Image clear = draw("scattering");
    builder_.ground({0, 6, 0}, 60, glass(tint));
    EXPECT_GT(pixel(clear, 0.5).r, 0);
    expect_near(pixel(draw("scattering"), 0.5) / pixel(clear, 0.5), tint, 0.002, "behind");
}

/// The share of light of the marches' parts, relit, and froxels that keep the visibility of frames.
TEST_F(GlassInAir, ColoursWhatIsFilteredAndKept) {
    volumetrics_.settings.filter.kernel = volumetrics::Filter::gaussian15;
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::accumulate;
    for (const char* technique : {"ray_march", "froxel"}) {
        volumetrics_.settings.technique = technique;
        for (const Lit kind : {Lit::sun, Lit::point}) {
            Image images[2];
            for (const bool through : {false, true}) {
                builder_ = {};
                air(kind, through ? glass(tint) : -1);
                for (options_.frame_index = 0; options_.frame_index < 3; ++options_.frame_index)
                    images[through ? 1 : 0] = draw("scattering");
            }
            const std::string what = std::string(technique) + " light " + std::to_string(int(kind));
            expect_near(pixel(images[1], 0.5) / pixel(images[0], 0.5), tint, 0.003, what);
        }
    }
}

TEST_F(GlassInAir, WithoutGlassNothingIsPaid) {
    const auto has_glass = [this] {
        const auto textures = renderer_.passes().textures();
        const bool maps = std::ranges::any_of(
            textures, [](const auto& t) { return t.name == "sun glass" || t.name == "lamp glass"; });
        EXPECT_EQ(renderer_.facts().glass() != 0, maps);
        return maps;
    };
    for (const Lit kind : {Lit::sun, Lit::point}) {
        builder_ = {};
        air(kind, -1);
        (void)draw();
        EXPECT_FALSE(has_glass());
        EXPECT_EQ(reason("shadow_sun/glass_0"),
                  kind == Lit::sun ? "no glass between the sun and what is in view" : "no sun in the scene");
        EXPECT_EQ(reason("shadow_atlas/glass"),
                  kind == Lit::point ? "no glass before a lamp in view" : "no lamp in view");

        // Glass that casts no shadow, and glass that no light in view comes through.
        builder_ = {};
        air(kind, glass(tint));
        builder_.scene.nodes.back().cast_shadow = false;
        (void)draw();
        EXPECT_FALSE(has_glass());

        builder_ = {};
        air(kind, glass(tint));
        (void)draw();
        EXPECT_TRUE(has_glass());
        options_.render.shadows = false;
        (void)draw();
        EXPECT_FALSE(has_glass());
        options_.render.shadows = true;
    }
}

TEST_F(GlassInAir, MapsAreDrawnAgainOnlyWhenSomethingChanged) {
    air(Lit::sun, glass(tint));
    builder_.point({0, 8, -2}, glm::vec3(9e4f), 60, true);
    renderer_.prepare(builder_.finish());
    Scene& scene = builder_.scene;
    Node& sheet = scene.nodes[static_cast<std::size_t>(scene.nodes.size()) - 2];
    const auto runs = [&] {
        renderer_.render(scene, view_, size_, options_);
        const auto names = renderer_.passes().live_pass_names();
        return std::pair(std::ranges::count(names, "shadow_sun/glass_0"),
                         std::ranges::count(names, "shadow_atlas/glass"));
    };
    EXPECT_EQ(runs(), std::pair(1L, 1L));
    EXPECT_EQ(runs(), std::pair(0L, 0L));
    EXPECT_EQ(reason("shadow_sun/glass_0"), "unchanged since it was drawn");
    EXPECT_EQ(reason("shadow_atlas/glass"), "unchanged since it was drawn");
    sheet.dynamic = true;
    renderer_.prepare(scene);
    (void)runs();
    sheet.world[3].x += 1;
    EXPECT_EQ(runs(), std::pair(1L, 1L));
    EXPECT_EQ(runs(), std::pair(0L, 0L));
}

TEST(GlassReach, LightGoesOnBehindIt) {
    const Frustum view = Frustum::from(look_at({0, 0, 0}, {0, 0, -1}, 1, 0.1f, 1).view_projection);
    const auto box = [](glm::vec3 at) { return Aabb{at - glm::vec3(1), at + glm::vec3(1)}; };
    EXPECT_TRUE(shades(box({0, 0, -9}), {0, -1, 0}, view));
    EXPECT_TRUE(shades(box({0, 50, -9}), {0, -1, 0}, view));
    EXPECT_FALSE(shades(box({0, -50, -9}), {0, -1, 0}, view)) << "the light has passed";
    EXPECT_FALSE(shades(box({0, 50, 9}), {0, -1, 0}, view)) << "behind the eye";
    EXPECT_TRUE(shades(box({0, 50, 9}), {0, -1, -1}, view));
    EXPECT_FALSE(shades(box({50, 50, -9}), {0, -1, 0}, view)) << "beside";
}

}  // namespace
}  // namespace tyndall
