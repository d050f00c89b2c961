#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "reference/geometry.h"
#include "support/scene_of_triangles.h"

namespace tyndall::reference {
namespace {

using test::SceneOfTriangles;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A masked square, x and z from 0 to 4 at the height y = 2, with u along x and v along z.
SceneOfTriangles masked(glm::ivec2 size, const std::vector<std::uint8_t>& alpha, float cutoff, float factor = 1,
                        float tiles = 1) {
    SceneOfTriangles s;
    Picture picture{"mask", size, {}};
    for (const std::uint8_t a : alpha) picture.rgba.insert(picture.rgba.end(), {255, 255, 255, a});
    s.scene.pictures.push_back(picture);
    Material& material = s.scene.materials[0];
    material.alpha_mask = true;
    material.alpha_cutoff = cutoff;
    material.base_color.a = factor;
    material.base_color_picture = 0;
    SceneOfTriangles::quad(s.mesh(), {0, 2, 0}, {4, 0, 0}, {0, 0, 4});
    for (Vertex& vertex : s.scene.meshes[0].vertices)
        vertex.uv = tiles * vertex.uv - glm::vec2(tiles > 1 ? 1.3f : 0);
    return s;
}

void expect_dark(const std::vector<Interval>& lit, const std::vector<Interval>& dark, double begin, double end) {
    ASSERT_EQ(lit.size(), dark.size() + 1);
    for (std::size_t i = 0; i < lit.size(); ++i) {
        EXPECT_NEAR(lit[i].begin, i == 0 ? begin : dark[i - 1].end, 1e-9);
        EXPECT_NEAR(lit[i].end, i == dark.size() ? end : dark[i].begin, 1e-9);
    }
}

TEST(GeometryMask, CutOffsOfARamp) {
    // Two texels, 0 and 1: alpha rises from u = 1/4 to 3/4 and falls from 3/4 to 5/4.
    for (const double cutoff : {0.5, 0.25}) {
        const SceneOfTriangles s = masked({2, 1}, {0, 255}, static_cast<float>(cutoff));
        const Geometry geometry(s.scene, true);
        const std::vector<Interval> dark =
            cutoff == 0.5 ? std::vector<Interval>{{4, 6}} : std::vector<Interval>{{2, 2.5}, {3.5, 6}};
        expect_dark(geometry.lit_by_sun({-2, 0, 1.1}, {1, 0, 0}, 0, 10, {0, 1, 0}), dark, 0, 10);
    }
    // The factor makes the cutoff 0.25 of the picture's alpha; a lamp at twice the height doubles the shadow.
    const SceneOfTriangles s = masked({2, 1}, {0, 255}, 0.125f, 0.5f);
    const Geometry geometry(s.scene, true);
    expect_dark(geometry.lit_by_lamp({-2, 0, 1}, {1, 0, 0}, 0, 12, {0, 4, 1}), {{2, 3}, {5, 10}}, 0, 12);
}

TEST(GeometryMask, AcrossARidgeAlphaIsAParabola) {
    // Along the diagonal of a cell between texel centres, from one of alpha 0 to the other, with 1 at the other two
    // corners: alpha = 2 s (1 - s), s from u = 1/4 to 3/4.
    const SceneOfTriangles s = masked({2, 2}, {0, 255, 255, 0}, 0.375f);
    const Geometry geometry(s.scene, true);
    const dvec3 d = glm::normalize(dvec3(1, 0, 1));
    const auto lit = geometry.lit_by_sun({1, 0, 1}, d, 0, 2 * std::sqrt(2), {0, 1, 0});
    // 2 s (1 - s) = 3/8 at s = 1/4 and 3/4; s = 1 is 2 m on in x and z.
    expect_dark(lit, {{0.5 * std::sqrt(2), 1.5 * std::sqrt(2)}}, 0, 2 * std::sqrt(2));
}

TEST(GeometryMask, TheEyeLooksThroughTheHoles) {
    const SceneOfTriangles s = masked({2, 1}, {0, 255}, 0.5f);
    const Geometry geometry(s.scene, true);
    EXPECT_FALSE(geometry.closest_hit({1.9, 5, 1}, {0, -1, 0}, 0));
    EXPECT_TRUE(geometry.closest_hit({2.1, 5, 1}, {0, -1, 0}, 0));
    EXPECT_FALSE(geometry.occluded({1.9, 0, 1}, {0, 1, 0}, infinity, 0));
    EXPECT_TRUE(geometry.occluded({2.1, 0, 1}, {0, 1, 0}, infinity, 0));
}

TEST(GeometryMask, WithoutAPictureTheFactorDecides) {
    SceneOfTriangles s = masked({2, 1}, {0, 255}, 0.5f, 0.6f);
    s.scene.materials[0].base_color_picture = -1;
    EXPECT_TRUE(Geometry(s.scene, true).occluded({1, 0, 1}, {0, 1, 0}, infinity, 0));
    s.scene.materials[0].base_color.a = 0.4f;
    const Geometry clear(s.scene, true);
    EXPECT_FALSE(clear.occluded({1, 0, 1}, {0, 1, 0}, infinity, 0));
    EXPECT_EQ(clear.lit_by_sun({-2, 0, 1}, {1, 0, 0}, 0, 10, {0, 1, 0}).size(), 1u);
}

TEST(GeometryMask, VertexAlphaMultipliesThePictures) {
    // Alpha of the vertices falls from 1 to 0 along x: times the ramp of two texels, rising from u = 1/4 to 3/4.
    SceneOfTriangles s = masked({2, 1}, {0, 255}, 0.125f);
    for (Vertex& vertex : s.scene.meshes[0].vertices) vertex.color.a = 1 - vertex.uv.x;
    // (2 u - 1/2) (1 - u) = 1/8 at u = (5 - sqrt 5) / 8 = 0.3455 and (5 + sqrt 5) / 8 = 0.9045, of which the latter
    // lies behind u = 3/4. There the picture falls: (5/2 - 2 u) (1 - u) = 1/8 at u = (9 - sqrt 5) / 8 = 0.8455.
    // Before u = 1/4: (1/2 - 2 u) (1 - u) = 1/8 at u = (5 - sqrt 13) / 8.
    const double first = (5 - std::sqrt(13)) / 8, begin = (5 - std::sqrt(5)) / 8, end = (9 - std::sqrt(5)) / 8;
    const Geometry geometry(s.scene, true);
    expect_dark(geometry.lit_by_sun({-2, 0, 1.1}, {1, 0, 0}, 0, 10, {0, 1, 0}),
                {{2, 2 + 4 * first}, {2 + 4 * begin, 2 + 4 * end}}, 0, 10);
    EXPECT_FALSE(geometry.closest_hit({4 * begin - 0.01, 5, 1.1}, {0, -1, 0}, 0));
    EXPECT_TRUE(geometry.closest_hit({4 * begin + 0.01, 5, 1.1}, {0, -1, 0}, 0));
    // Without a picture: half way.
    s.scene.materials[0].base_color_picture = -1;
    s.scene.materials[0].alpha_cutoff = 0.5f;
    expect_dark(Geometry(s.scene, true).lit_by_sun({-2, 0, 1.1}, {1, 0, 0}, 0, 10, {0, 1, 0}), {{2, 4}}, 0, 10);
}

/// Of the noisy mask below: how it is read beyond its edges and between its texels, and whether vertices have
/// alpha.
class NoisyMask : public testing::TestWithParam<std::tuple<Wrap, bool, bool>> {};

TEST_P(NoisyMask, AgreesWithShadowRays) {
    const auto [wrap, nearest, vertex_alpha] = GetParam();
    std::mt19937 random(23);
    std::uniform_int_distribution<int> byte(0, 255);
    std::vector<std::uint8_t> alpha(8 * 5);
    for (std::uint8_t& a : alpha) a = static_cast<std::uint8_t>(byte(random));
    SceneOfTriangles s = masked({8, 5}, alpha, vertex_alpha ? 0.25f : 0.5f, 1, 3);
    s.scene.pictures[0].sampling = {.u = wrap, .v = wrap, .nearest = nearest};
    if (vertex_alpha)
        for (std::size_t i = 0; i < 4; ++i)
            s.scene.meshes[0].vertices[i].color.a = 0.3f + 0.2f * static_cast<float>(i);
    const Geometry geometry(s.scene, true);
    std::uniform_real_distribution<double> unit(0, 1);
    int dark = 0, asked = 0;
    for (int i = 0; i < 200; ++i) {
        const dvec3 origin(4 * unit(random), unit(random), 4 * unit(random));
        const dvec3 d = glm::normalize(dvec3(unit(random) - 0.5, 0.2 * unit(random), unit(random) - 0.5));
        const dvec3 to_sun = glm::normalize(dvec3(unit(random) - 0.5, 1, unit(random) - 0.5));
        const auto lit = geometry.lit_by_sun(origin, d, 0, 3, to_sun);
        for (int k = 0; k < 20; ++k) {
            const double t = 3 * unit(random);
            bool inside = false, at_edge = false;
            for (const Interval& interval : lit) {
                inside = inside || (t > interval.begin && t < interval.end);
                at_edge = at_edge || std::abs(t - interval.begin) < 1e-4 || std::abs(t - interval.end) < 1e-4;
            }
            if (at_edge) continue;
            EXPECT_EQ(geometry.occluded(origin + t * d, to_sun, infinity, 0), !inside) << t;
            ++asked;
            dark += !inside;
        }
    }
    EXPECT_GT(asked, 3000);
    EXPECT_GT(dark, asked / 5);
    EXPECT_LT(dark, asked * 4 / 5);
}

INSTANTIATE_TEST_SUITE_P(Ways, NoisyMask,
                         testing::Combine(testing::Values(Wrap::repeat, Wrap::mirror, Wrap::clamp), testing::Bool(),
                                          testing::Bool()));

}  // namespace
}  // namespace tyndall::reference
