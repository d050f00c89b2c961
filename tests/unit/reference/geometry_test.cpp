#include "reference/geometry.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/scene_of_triangles.h"

namespace tyndall::reference {
namespace {

using test::SceneOfTriangles;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Geometry, FindsThePlaneWhereTheFormulaSays) {
    SceneOfTriangles s;
    // y = 0.25 x + 1
    SceneOfTriangles::quad(s.mesh(), {-50, -11.5f, -50}, {0, 0, 100}, {100, 25, 0});
    const Geometry geometry(s.scene, true);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const dvec3 origin(unit(random), 8 + unit(random), unit(random));
        const dvec3 d = glm::normalize(dvec3(unit(random), -1.5, unit(random)));
        // origin.y + t d.y = 0.25 (origin.x + t d.x) + 1
        const double t = (0.25 * origin.x + 1 - origin.y) / (d.y - 0.25 * d.x);
        const auto hit = geometry.closest_hit(origin, d, 0);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, t, 1e-9);
        EXPECT_TRUE(hit->front);
        EXPECT_FALSE(geometry.closest_hit(origin, -d, 0));
        EXPECT_FALSE(geometry.closest_hit(origin, d, t + 1e-7));
    }
}

TEST(Geometry, BarycentricCoordinatesGiveThePoint) {
    SceneOfTriangles s;
    const dvec3 corner[] = {{1, 2, 3}, {4, 2.5, 2}, {0.5, 6, 1}};
    SceneOfTriangles::triangle(s.mesh(), corner[0], corner[1], corner[2]);
    const Geometry geometry(s.scene, true);
    for (const dvec2 w : {dvec2(0.1, 0.2), dvec2(0.7, 0.1), dvec2(0.25, 0.7)}) {
        const dvec3 point = corner[0] + w.x * (corner[1] - corner[0]) + w.y * (corner[2] - corner[0]);
        const dvec3 eye(3, 4, 30);
        const auto hit = geometry.closest_hit(eye, glm::normalize(point - eye), 0);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, glm::distance(eye, point), 1e-9);
        EXPECT_NEAR(hit->barycentric.x, w.x, 1e-9);
        EXPECT_NEAR(hit->barycentric.y, w.y, 1e-9);
    }
}

TEST(Geometry, NodesPlaceAndMirror) {
    SceneOfTriangles s;
    s.scene.materials[0].double_sided = false;
    SceneOfTriangles::quad(s.mesh(), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});  // faces +Z
    for (const float mirror : {1.0f, -1.0f}) {
        s.scene.nodes[0].world = glm::mat4({mirror, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {100, 200, 300, 1});
        const Geometry geometry(s.scene, true);
        const auto hit = geometry.closest_hit({100.5, 200.25, 310}, {0, 0, -1}, 0);
        ASSERT_TRUE(hit) << mirror;
        EXPECT_NEAR(hit->distance, 10, 1e-9);
        EXPECT_TRUE(hit->front);
        // The back of a one-sided material is not seen, and blocks light.
        EXPECT_FALSE(geometry.closest_hit({100.5, 200.25, 290}, {0, 0, 1}, 0));
        EXPECT_TRUE(geometry.occluded({100.5, 200.25, 290}, {0, 0, 1}, 20, 1e-4));
    }
    s.scene.materials[0].double_sided = true;
    const Geometry two_sided(s.scene, true);
    const auto back = two_sided.closest_hit({100.5, 200.25, 290}, {0, 0, 1}, 0);
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->front);
}

TEST(Geometry, FarFromTheOriginDistancesStayExact) {
    SceneOfTriangles s;
    SceneOfTriangles::box(s.mesh(), {999999, -1, -1}, {1000001, 1, 1});
    const Geometry geometry(s.scene, true);
    const auto hit = geometry.closest_hit({999990, 0.3, 0.2}, {1, 0, 0}, 0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 9, 1e-8);
    const auto lit = geometry.lit_by_sun({1000000.0, -5, 0.1}, {0, 0, 1}, 0, 10, {0, 1, 0});
    ASSERT_EQ(lit.size(), 1u);
    EXPECT_NEAR(lit[0].begin, 0.9, 1e-8);
}

TEST(Geometry, OcclusionIgnoresTheSkinOfBothEnds) {
    SceneOfTriangles s;
    SceneOfTriangles::quad(s.mesh(), {-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
    SceneOfTriangles::quad(s.mesh(), {-5, 3, -5}, {0, 0, 10}, {10, 0, 0});
    const Geometry geometry(s.scene, true);
    EXPECT_FALSE(geometry.occluded({0.1, 0, 0.2}, {0, 1, 0}, 3, 1e-4));
    EXPECT_TRUE(geometry.occluded({0.1, 0, 0.2}, {0, 1, 0}, 3.001, 1e-4));
    EXPECT_TRUE(geometry.occluded({0.1, -0.001, 0.2}, {0, 1, 0}, 2, 1e-4));
    EXPECT_TRUE(geometry.occluded({0.1, 0, 0.2}, {0, 1, 0}, infinity, 1e-4));
    EXPECT_FALSE(geometry.occluded({0.1, 3, 0.2}, {0, 1, 0}, infinity, 1e-4));
    EXPECT_FALSE(geometry.occluded({0.1, 1, 0.2}, {0, 1, 0}, 1e-5, 1e-4));
}

TEST(Geometry, WhatCastsNoShadowIsSeenAndBlendedSurfacesAreNot) {
    SceneOfTriangles s;
    SceneOfTriangles::box(s.mesh(), {-1, -1, -1}, {1, 1, 1});
    s.scene.nodes[0].cast_shadow = false;
    const Geometry seen(s.scene, true);
    EXPECT_TRUE(seen.closest_hit({0.1, 0.2, 9}, {0, 0, -1}, 0));
    EXPECT_FALSE(seen.occluded({0.1, 0.2, 9}, {0, 0, -1}, 20, 0));
    EXPECT_EQ(seen.lit_by_sun({0.1, -5, 0.2}, {0, 0, 1}, 0, 3, {0, 1, 0}).size(), 1u);

    s.scene.nodes[0].cast_shadow = true;
    s.scene.materials[0].alpha_blend = true;
    const Geometry blended(s.scene, true);
    EXPECT_FALSE(blended.closest_hit({0.1, 0.2, 9}, {0, 0, -1}, 0));
    EXPECT_FALSE(blended.occluded({0.1, 0.2, 9}, {0, 0, -1}, 20, 0));
}

TEST(Geometry, WithoutShadowsEverythingIsLit) {
    SceneOfTriangles s;
    SceneOfTriangles::box(s.mesh(), {-1, -1, -1}, {1, 1, 1});
    const Geometry geometry(s.scene, false);
    EXPECT_TRUE(geometry.closest_hit({0.1, 0.2, 9}, {0, 0, -1}, 0));
    EXPECT_FALSE(geometry.occluded({0.1, 0.2, 9}, {0, 0, -1}, 20, 0));
    const auto sun = geometry.lit_by_sun({0, -5, 0}, {1, 0, 0}, -3, 3, {0, 1, 0});
    const auto lamp = geometry.lit_by_lamp({0, -5, 0}, {1, 0, 0}, -3, 3, {0, 9, 0});
    for (const auto& lit : {sun, lamp}) {
        ASSERT_EQ(lit.size(), 1u);
        EXPECT_EQ(lit[0].begin, -3);
        EXPECT_EQ(lit[0].end, 3);
    }
}

TEST(Geometry, AnEmptySceneIsLitEverywhere) {
    const Scene scene;
    const Geometry geometry(scene, true);
    EXPECT_FALSE(geometry.closest_hit({0, 0, 0}, {0, 0, 1}, 0));
    EXPECT_FALSE(geometry.occluded({0, 0, 0}, {0, 0, 1}, infinity, 0));
    EXPECT_EQ(geometry.lit_by_sun({0, 0, 0}, {0, 0, 1}, 0, infinity, {0, 1, 0}).at(0).end, infinity);
    EXPECT_EQ(geometry.lit_by_sun({0, 0, 0}, {0, 1, 0}, 0, infinity, {0, 1, 0}).at(0).end, infinity);
    EXPECT_EQ(geometry.lit_by_lamp({0, 0, 0}, {0, 1, 0}, 0, infinity, {0, 0, 0}).at(0).end, infinity);
}

}  // namespace
}  // namespace tyndall::reference
