#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "reference/geometry.h"
#include "support/scene_of_triangles.h"

namespace tyndall::reference {
namespace {

using test::SceneOfTriangles;

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_intervals(const std::vector<Interval>& found, const std::vector<Interval>& expected, double tolerance) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i].begin, expected[i].begin, tolerance) << i;
        if (expected[i].end == infinity)
            EXPECT_EQ(found[i].end, infinity);
        else
            EXPECT_NEAR(found[i].end, expected[i].end, tolerance) << i;
    }
}

/// Slats in the plane z = 0, endless along y: slat i covers x from i to i + 0.375.
SceneOfTriangles grille(int count) {
    SceneOfTriangles s;
    Mesh& mesh = s.mesh();
    for (int i = 0; i < count; ++i)
        SceneOfTriangles::quad(mesh, {static_cast<float>(i), -50, 0}, {0.375f, 0, 0}, {0, 100, 0});
    return s;
}

/// What is lit of a ray whose point t is darkened by the slats where across(t), increasing, meets them.
template <class Inverse>
std::vector<Interval> between_slats(int count, double begin, double end, Inverse t_of_x) {
    std::vector<Interval> lit;
    for (int i = 0; i < count; ++i) {
        lit.push_back({begin, t_of_x(i)});
        begin = t_of_x(i + 0.375);
    }
    lit.push_back({begin, end});
    return lit;
}

TEST(GeometryLit, SunThroughAGrille) {
    const SceneOfTriangles s = grille(20);
    const Geometry geometry(s.scene, true);
    const dvec3 to_sun = glm::normalize(dvec3(0.3, 0.2, 1));
    for (const double slope : {0.0, 0.25, -0.4}) {
        const dvec3 origin(-3, 0.7, -7), across(1, 0.1, slope);
        const dvec3 d = glm::normalize(across);
        // A point meets the grille's plane at x - 0.3 z: (-3 + 2.1) + s (1 - 0.3 slope), s = t d.x.
        const auto t_of_x = [&](double x) { return (x + 0.9) / (1 - 0.3 * slope) / d.x; };
        const double end = t_of_x(25);
        expect_intervals(geometry.lit_by_sun(origin, d, 0, end, to_sun), between_slats(20, 0, end, t_of_x), 1e-10);
    }
}

TEST(GeometryLit, LampThroughAGrille) {
    const SceneOfTriangles s = grille(20);
    const Geometry geometry(s.scene, true);
    const dvec3 lamp(8.3, 1.5, 3);
    // On a ray at z = -5 an edge at x falls on lamp.x + (x - lamp.x) (3 + 5) / 3.
    const auto t_of_x = [&](double x) { return 40 + lamp.x + (x - lamp.x) * 8 / 3; };
    expect_intervals(geometry.lit_by_lamp({-40, 0.3, -5}, {1, 0, 0}, 0, 100, lamp),
                     between_slats(20, 0, 100, t_of_x), 1e-10);
}

TEST(GeometryLit, ShadowOfABox) {
    SceneOfTriangles s;
    SceneOfTriangles::box(s.mesh(), {-1, -1, -1}, {1, 1, 1});
    const Geometry geometry(s.scene, true);
    // Two metres below the centre, x meets the box if x + 0.5 k is in [-1, 1] for a k in [1, 3].
    expect_intervals(geometry.lit_by_sun({-10, -2, 0.2}, {1, 0, 0}, 0, 20, glm::normalize(dvec3(0.5, 1, 0))),
                     {{0, 7.5}, {10.5, 20}}, 1e-12);
    // A lamp 3 m above the centre: the upper rim, 2 m below it, bounds the shadow 5 m below it.
    expect_intervals(geometry.lit_by_lamp({-10, -2, 0.2}, {1, 0, 0}, 0, 20, {0, 3, 0}), {{0, 7.5}, {12.5, 20}},
                     1e-12);
    // Between lamp and box nothing is dark; beyond the lamp neither.
    expect_intervals(geometry.lit_by_lamp({-10, 2, 0.2}, {1, 0, 0}, 0, 20, {0, 3, 0}), {{0, 20}}, 0);
    expect_intervals(geometry.lit_by_lamp({-10, 4, 0.2}, {1, 0, 0}, 0, 20, {0, 3, 0}), {{0, 20}}, 0);
}

TEST(GeometryLit, ShadowOfASphereIsACylinderAndACone) {
    SceneOfTriangles s;
    SceneOfTriangles::sphere(s.mesh(), {1, 2, 3}, 0.5f, 160);
    const Geometry geometry(s.scene, true);
    // The mesh lies within 0.5 (1 - cos(pi / 160)²) < 2e-4 of the sphere.
    const double chord = std::sqrt(0.25 - 0.09);
    expect_intervals(geometry.lit_by_sun({-4, -3, 3.3}, {1, 0, 0}, 0, 10, {0, 1, 0}),
                     {{0, 5 - chord}, {5 + chord, 10}}, 4e-4);
    // From 4 m above the centre the cone's half angle has the sine 0.5 / 4.
    const double half = 9 * 0.125 / std::sqrt(1 - 0.125 * 0.125);
    expect_intervals(geometry.lit_by_lamp({-4, -3, 3}, {1, 0, 0}, 0, 10, {1, 6, 3}),
                     {{0, 5 - half}, {5 + half, 10}}, 1e-3);
}

TEST(GeometryLit, APostOfAMillimetreThirtyMetresAway) {
    SceneOfTriangles s;
    const float half = 0.0005f;
    SceneOfTriangles::box(s.mesh(), {-half, -10, 30 - half}, {half, 10, 30 + half});
    const Geometry geometry(s.scene, true);
    const double low = 5 - double{half}, high = 5 + double{half};
    expect_intervals(geometry.lit_by_sun({-5, 0.1, 0}, {1, 0, 0}, 0, 10, {0, 0, 1}), {{0, low}, {high, 10}}, 1e-12);
    // A lamp 60 m away sees the nearer face's edges: 30.0005 m from it, doubled on the ray.
    const double wide = double{half} * 60 / (60 - double{30 + half});
    expect_intervals(geometry.lit_by_lamp({-5, 0, 0}, {1, 0, 0}, 0, 10, {0, 0, 60}),
                     {{0, 5 - wide}, {5 + wide, 10}}, 1e-9);
}

TEST(GeometryLit, InsideAClosedSurfaceIsDarkWithoutACrack) {
    SceneOfTriangles s;
    SceneOfTriangles::sphere(s.mesh(), {0, 0, 0}, 2, 40);
    const Geometry geometry(s.scene, true);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&] { return dvec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 300; ++i) {
        const dvec3 origin = vector(), d = glm::normalize(vector());
        EXPECT_TRUE(geometry.lit_by_sun(origin, d, 0, 0.2, glm::normalize(vector())).empty());
        EXPECT_TRUE(geometry.lit_by_lamp(origin, d, 0, 0.2, 3.0 * glm::normalize(vector())).empty());
        expect_intervals(geometry.lit_by_lamp(origin, d, 0, 0.2, vector()), {{0, 0.2}}, 0);
    }
}

TEST(GeometryLit, AgreesWithShadowRaysInATangleOfTriangles) {
    SceneOfTriangles s;
    Mesh& mesh = s.mesh();
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double scale) { return scale * dvec3(unit(random), unit(random), unit(random)); };
    for (int i = 0; i < 400; ++i) {
        const dvec3 at = vector(5);
        SceneOfTriangles::triangle(mesh, at, at + vector(1), at + vector(1));
    }
    const Geometry geometry(s.scene, true);
    int dark = 0, asked = 0;
    const auto compare = [&](const std::vector<Interval>& lit, auto occluded) {
        double last = 0;
        for (const Interval& interval : lit) {
            EXPECT_LE(last, interval.begin);
            EXPECT_LT(interval.begin, interval.end);
            last = interval.end;
        }
        EXPECT_LE(last, 8);
        for (int k = 0; k < 8; ++k) {
            const double t = 4 + 4 * unit(random);
            bool inside = false, at_edge = false;
            for (const Interval& interval : lit) {
                inside = inside || (t > interval.begin && t < interval.end);
                at_edge = at_edge || std::abs(t - interval.begin) < 1e-3 || std::abs(t - interval.end) < 1e-3;
            }
            if (at_edge) continue;
            EXPECT_EQ(occluded(t), !inside) << t;
            ++asked;
            dark += !inside;
        }
    };
    for (int i = 0; i < 400; ++i) {
        const dvec3 origin = vector(5), d = glm::normalize(vector(1)), lamp = vector(5);
        const dvec3 to_sun = glm::normalize(vector(1));
        compare(geometry.lit_by_sun(origin, d, 0, 8, to_sun),
                [&](double t) { return geometry.occluded(origin + t * d, to_sun, infinity, 1e-6); });
        compare(geometry.lit_by_lamp(origin, d, 0, 8, lamp), [&](double t) {
            const dvec3 to_lamp = lamp - (origin + t * d);
            const double distance = glm::length(to_lamp);
            return geometry.occluded(origin + t * d, to_lamp / distance, distance, 1e-6);
        });
    }
    EXPECT_GT(asked, 4000);
    EXPECT_GT(dark, asked / 4);
    EXPECT_LT(dark, asked * 3 / 4);
}

/// A box from 5 to 7 m and a floor at 1 m above the origin.
SceneOfTriangles column() {
    SceneOfTriangles s;
    SceneOfTriangles::box(s.mesh(), {-1, 5, -1}, {1, 7, 1});
    SceneOfTriangles::quad(s.mesh(), {-4, 1, -4}, {0, 0, 8}, {8, 0, 0});
    return s;
}

TEST(GeometryLit, AlongTheLightUpToTheFirstSurface) {
    const SceneOfTriangles s = column();
    const Geometry geometry(s.scene, true);
    const dvec3 up(0, 1, 0);
    expect_intervals(geometry.lit_by_sun({0.1, 0, 0.2}, up, 0, 20, up), {{7, 20}}, 1e-9);
    expect_intervals(geometry.lit_by_sun({0.1, 10, 0.2}, -up, 0, 20, up), {{0, 3}}, 1e-9);
    expect_intervals(geometry.lit_by_sun({0.1, 10, 0.2}, -up, 0, 2, up), {{0, 2}}, 0);
    EXPECT_TRUE(geometry.lit_by_sun({0.1, 2, 0.2}, up, 0, 4.5, up).empty());
    expect_intervals(geometry.lit_by_sun({3.1, 2, 0.2}, up, 0, infinity, up), {{0, infinity}}, 0);
    // Through a lamp between floor and box.
    expect_intervals(geometry.lit_by_lamp({0.1, 0, 0.2}, up, 0, 20, {0.1, 4, 0.2}), {{1, 5}}, 1e-9);
    expect_intervals(geometry.lit_by_lamp({0.1, 4, 0.2}, up, 0, 20, {0.1, 4, 0.2}), {{0, 1}}, 1e-9);
    expect_intervals(geometry.lit_by_lamp({0.1, 9, 0.2}, up, 0, 20, {0.1, 4, 0.2}), {}, 0);
}

TEST(GeometryLit, NearlyAlongTheLightIsTheSame) {
    const SceneOfTriangles s = column();
    const Geometry geometry(s.scene, true);
    const dvec3 up(0, 1, 0);
    for (const double angle : {1e-10, 1e-8, 1e-6, 1e-5}) {
        // Along the ray the box's sides lie metres / angle away: the shadow ends at the top still.
        const dvec3 d = glm::normalize(dvec3(angle, 1, 0.3 * angle));
        expect_intervals(geometry.lit_by_sun({0.1, 0, 0.2}, d, 0, 20, up), {{7, 20}}, 1e-6);
        expect_intervals(geometry.lit_by_lamp({0.1, 0, 0.2}, d, 0, 20, {0.1, 4, 0.2}), {{1, 5}}, 1e-4);
    }
}

TEST(GeometryLit, SurfacesThatTheLampOrTheRayLiesInDoNotDarken) {
    SceneOfTriangles s;
    SceneOfTriangles::quad(s.mesh(), {-5, 3, -5}, {10, 0, 0}, {0, 0, 10});
    SceneOfTriangles::quad(s.mesh(), {-5, 0, -5}, {0, 0, 10}, {10, 0, 0});
    const Geometry geometry(s.scene, true);
    expect_intervals(geometry.lit_by_lamp({-4, 1, 0.5}, {1, 0, 0}, 0, 8, {0.3, 3, 0.2}), {{0, 8}}, 0);
    expect_intervals(geometry.lit_by_lamp({-4, 0, 0.5}, {1, 0, 0}, 0, 8, {0.3, 2, 0.2}), {{0, 8}}, 0);
    // A ray that starts on a surface is lit on the light's side of it, and dark on the other.
    const dvec3 down = glm::normalize(dvec3(1, -0.5, 0.1));
    expect_intervals(geometry.lit_by_lamp({-4, 0, 0.5}, glm::normalize(dvec3(1, 0.5, 0)), 0, 4, {0.3, 2, 0.2}),
                     {{0, 4}}, 0);
    for (const Interval& lit : geometry.lit_by_lamp({-1, 0, 0.5}, down, 0, 2, {0.3, 2, 0.2}))
        EXPECT_LT(lit.end, 1e-8);
}

TEST(GeometryLit, TrianglesWithoutAreaDoNothing) {
    SceneOfTriangles s;
    Mesh& mesh = s.mesh();
    SceneOfTriangles::quad(mesh, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    for (const std::uint32_t i : {0u, 0u, 1u, 2u, 2u, 2u}) mesh.indices.push_back(i);
    const Geometry geometry(s.scene, true);
    expect_intervals(geometry.lit_by_sun({-5, 0, 0.1}, {1, 0, 0}, 0, 10, {0, 1, 0}), {{0, 4}, {6, 10}}, 1e-12);
}

TEST(GeometryLit, GoesOnToInfinity) {
    SceneOfTriangles s;
    SceneOfTriangles::quad(s.mesh(), {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    const Geometry geometry(s.scene, true);
    expect_intervals(geometry.lit_by_sun({-5, 0, 0.1}, {1, 0, 0}, 0, infinity, {0, 1, 0}), {{0, 4}, {6, infinity}},
                     1e-12);
    expect_intervals(geometry.lit_by_lamp({-5, 0, 0}, {1, 0, 0}, 0, infinity, {0, 4, 0}), {{0, 3}, {7, infinity}},
                     1e-12);
    EXPECT_TRUE(geometry.lit_by_sun({-5, 0, 0.1}, {1, 0, 0}, 3, 3, {0, 1, 0}).empty());
}

}  // namespace
}  // namespace tyndall::reference
