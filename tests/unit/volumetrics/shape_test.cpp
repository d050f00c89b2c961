#include "modules/volumetrics/src/media/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "shaders/lib/glm_subset.h"

namespace tyndall::glsl {
using shared::LocalMedium;
}
TYNDALL_GLSL_BEGIN
#include "shaders/volumetrics/media/shape.glsl"
TYNDALL_GLSL_END

namespace tyndall::volumetrics {
namespace {

using glm::vec3;

struct Case {
    std::string name;
    LocalMedium medium;
};

/// Each shape: even, long and turned, thin and turned, with a rim that is soft up to its middle.
std::vector<Case> cases() {
    const glm::quat turned = glm::angleAxis(0.9F, glm::normalize(vec3(1, 2, -1)));
    std::vector<Case> all;
    for (const auto& [name, shape] : {std::pair{"ellipsoid", Shape::ellipsoid}, std::pair{"box", Shape::box}}) {
        const std::string of = name;
        all.push_back({of, {.shape = shape, .center = {1, -2, 3}, .half_extent = vec3(1.5F)}});
        all.push_back({of + ", long",
                       {.shape = shape, .center = {-3, 0, 1}, .half_extent = {0.5F, 2, 1}, .rotation = turned}});
        all.push_back({of + ", thin",
                       {.shape = shape, .center = {0, 4, 0}, .half_extent = {2, 0.01F, 1}, .rotation = turned}});
        all.push_back(
            {of + ", soft", {.shape = shape, .half_extent = {1, 1.5F, 0.7F}, .rotation = turned, .softness = 2}});
    }
    return all;
}

class Points {
  public:
    /// Even in the box round a medium, or in one `wider` times as wide, in the world.
    vec3 near(const LocalMedium& m, float wider = 1) {
        return m.center + m.rotation * (wider * m.half_extent * vec3(unit(), unit(), unit()));
    }
    vec3 direction() {
        const vec3 v{normal_(random_), normal_(random_), normal_(random_)};
        return glm::normalize(v);
    }
    float unit() { return unit_(random_); }  ///< -1..1

  private:
    std::mt19937 random_{1};
    std::uniform_real_distribution<float> unit_{-1, 1};
    std::normal_distribution<float> normal_;
};

/// By what a shape is, in double precision, from the description: not as the shaders do.
bool holds(const LocalMedium& m, glm::dvec3 point) {
    const glm::dvec3 p =
        glm::conjugate(glm::dquat(m.rotation)) * (point - glm::dvec3(m.center)) / glm::dvec3(m.half_extent);
    if (m.shape == Shape::box) return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1;
    return glm::dot(p, p) < 1;
}

float density(const shared::LocalMedium& m, vec3 point) {
    return glsl::shape_density(m, vec3(m.world_to_shape * glm::vec4(point, 1)));
}

TEST(Shape, DensityIsPositiveInsideAlone) {
    for (const Case& c : cases()) {
        Points points;
        const shared::LocalMedium m = pack_shape(c.medium);
        int inside = 0, differ = 0;
        for (int i = 0; i < 20000; ++i) {
            const vec3 p = points.near(c.medium, 1.3F);
            inside += holds(c.medium, p);
            differ += holds(c.medium, p) != (density(m, p) > 0);
        }
        EXPECT_GT(inside, 4000) << c.name;
        EXPECT_LE(differ, 5) << c.name << ": more than rounding at the rim";
    }
}

TEST(Shape, DepthOfABoxIsTheDistanceToTheNearestFace) {
    const vec3 half(2, 1, 3);
    EXPECT_EQ(glsl::box_depth(vec3(0), half), 1);
    EXPECT_NEAR(glsl::box_depth(vec3(1.9F, 0, 0), half), 0.1, 1e-6);
    EXPECT_NEAR(glsl::box_depth(vec3(-1.9F, 0.95F, -2.8F), half), 0.05, 1e-6);
    EXPECT_NEAR(glsl::box_depth(vec3(0, 0, 3.1F), half), -0.1, 1e-6);
}

TEST(Shape, DepthOfASphereIsTheDistanceToIt) {
    Points points;
    for (int i = 0; i < 1000; ++i) {
        const vec3 p = 2.2F * vec3(points.unit(), points.unit(), points.unit());
        EXPECT_NEAR(glsl::ellipsoid_depth(p, vec3(2)), 2 - glm::length(p), 2e-6F);
    }
}

TEST(Shape, DensityIsOneFromTheSoftnessInwards) {
    for (const Shape shape : {Shape::ellipsoid, Shape::box}) {
        const shared::LocalMedium soft = pack_shape({.shape = shape, .half_extent = {2, 3, 4}, .softness = 0.5F});
        EXPECT_EQ(glsl::shape_density(soft, vec3(0)), 1);
        EXPECT_EQ(glsl::shape_density(soft, vec3(1.4F, 0, 0)), 1);
        EXPECT_NEAR(glsl::shape_density(soft, vec3(0, 2.875F, 0)), 0.25, 1e-5);
        EXPECT_EQ(glsl::shape_density(soft, vec3(0, 0, -4.1F)), 0);
        EXPECT_FALSE(glsl::shape_is_even(soft));
        const shared::LocalMedium hard = pack_shape({.shape = shape, .half_extent = vec3(1)});
        EXPECT_EQ(glsl::shape_density(hard, vec3(0.999F, 0, 0)), 1);
        EXPECT_EQ(glsl::shape_density(hard, vec3(1.001F, 0, 0)), 0);
        EXPECT_TRUE(glsl::shape_is_even(hard));
        // Softer than the shape is deep: the centre does not reach 1.
        EXPECT_NEAR(
            glsl::shape_density(pack_shape({.shape = shape, .half_extent = vec3(2), .softness = 4}), vec3(0)), 0.5,
            1e-6);
    }
}

// True distance from inside an ellipsoid to its surface. The nearest surface point s satisfies
// p_i = s_i (1 + l / r_i^2) with l in (-min r^2, 0]; bisect on the implicit equation.
double true_depth(const glm::dvec3& p, const glm::dvec3& r) {
    const double smallest = std::min({r.x, r.y, r.z});
    double low = -smallest * smallest;
    double high = 0.0;
    const auto value = [&](double l) {
        double sum = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double s = p[i] / (1.0 + l / (r[i] * r[i]));
            sum += s * s / (r[i] * r[i]);
        }
        return sum - 1.0;
    };
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (value(middle) > 0.0 ? low : high) = middle;
    }
    double squares = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double s = p[i] / (1.0 + high / (r[i] * r[i]));
        squares += (p[i] - s) * (p[i] - s);
    }
    return std::sqrt(squares);
}

TEST(Shape, EllipsoidDepthIsCloseToTheDistance) {
    struct Bound {
        double axis_ratio;
        double too_large;
    };
    for (const Bound& bound : {Bound{1.5, 0.025}, Bound{2.0, 0.06}, Bound{4.0, 0.21}}) {
        std::mt19937 random(2);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (int i = 0; i < 20000; ++i) {
            const double stretch = bound.axis_ratio - 1.0;
            const glm::dvec3 radii(1.0, 1.0 + stretch * unit(random), 1.0 + stretch * unit(random));
            const glm::dvec3 surface =
                glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))) * radii;
            const glm::dvec3 normal_at_surface = glm::normalize(surface / (radii * radii));
            const glm::dvec3 p = surface - (0.001 + 0.249 * unit(random)) * normal_at_surface;
            const double depth = true_depth(p, radii);
            const double read = glsl::ellipsoid_depth(vec3(p), vec3(radii));
            ASSERT_GT(read / depth, 1.0 - 1e-3);
            ASSERT_LT(read / depth, 1.0 + bound.too_large);
        }
    }
}

// Of a ray that begins 8 m from the centre, 1/1000 m apart.
TEST(Shape, ChordIsWhereDensityIsPositive) {
    constexpr double step = 1e-3;
    for (const Case& c : cases()) {
        Points points;
        const shared::LocalMedium m = pack_shape(c.medium);
        int hits = 0;
        for (int i = 0; i < 100; ++i) {
            const vec3 through = points.near(c.medium, 1.1F), direction = points.direction();
            const vec3 origin = through - 8.0F * direction;
            const glm::vec2 chord = glsl::shape_chord(m, vec3(m.world_to_shape * glm::vec4(origin, 1)),
                                                      glm::mat3(m.world_to_shape) * direction);
            double first = 0, last = 0;
            for (double t = 0; t < 16; t += step) {
                if (!holds(c.medium, glm::dvec3(origin) + t * glm::dvec3(direction))) continue;
                if (first == 0) first = t;
                last = t;
            }
            if (first == 0) {
                EXPECT_LT(chord.y - chord.x, 2 * step) << c.name << " line " << i;
                continue;
            }
            ++hits;
            EXPECT_NEAR(chord.x, first, 1.1 * step) << c.name << " line " << i;
            EXPECT_NEAR(chord.y, last, 1.1 * step) << c.name << " line " << i;
        }
        EXPECT_GT(hits, 50) << c.name;
    }
}

// Lines along the axes of the shape meet faces that are parallel to them.
TEST(Shape, ChordAlongTheAxes) {
    for (const Case& c : cases()) {
        const shared::LocalMedium m = pack_shape(c.medium);
        for (int axis = 0; axis < 3; ++axis) {
            vec3 d(0), beside(0);
            d[axis] = 1;
            const float half = c.medium.half_extent[axis];
            const glm::vec2 chord = glsl::shape_chord(m, -5.0F * d, d);
            EXPECT_NEAR(chord.x, 5 - half, 1e-5) << c.name;
            EXPECT_NEAR(chord.y, 5 + half, 1e-5) << c.name;
            beside[(axis + 1) % 3] = 1.001F * c.medium.half_extent[(axis + 1) % 3];
            const glm::vec2 missed = glsl::shape_chord(m, beside - 5.0F * d, d);
            EXPECT_GE(missed.x, missed.y) << c.name;
        }
    }
}

TEST(Shape, WhatHasNoExtentHoldsNothing) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Shape shape : {Shape::ellipsoid, Shape::box}) {
        for (const vec3 half : {vec3(0), vec3(1, 0, 1), vec3(1, 1, -2)}) {
            const LocalMedium medium{.shape = shape, .half_extent = half};
            EXPECT_TRUE(is_empty(medium));
            const glm::vec2 chord = glsl::shape_chord(pack_shape(medium), vec3(0, 0, -5), vec3(0, 0, 1));
            EXPECT_GE(chord.x, chord.y);
        }
        EXPECT_TRUE(is_empty({.shape = shape, .half_extent = {1, nan, 1}}));
        EXPECT_FALSE(is_empty({.shape = shape, .half_extent = vec3(1e-6F)}));
    }
}

/// Points of its surface, from its centre, towards a lattice of 41 x 41 on each face of the box round it, edges
/// included.
std::vector<glm::dvec3> surface(const LocalMedium& m) {
    std::vector<glm::dvec3> all;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 41 * 41; ++i) {
            glm::dvec3 side;
            side[face % 3] = face < 3 ? 1 : -1;
            side[(face + 1) % 3] = i % 41 / 20.0 - 1;
            side[(face + 2) % 3] = i / 41 / 20.0 - 1;
            const glm::dvec3 to = glm::dquat(m.rotation) * (side * glm::dvec3(m.half_extent));
            double inside = 0, outside = 1.001;
            for (int k = 0; k < 30; ++k) {
                const double middle = (inside + outside) / 2;
                (holds(m, glm::dvec3(m.center) + middle * to) ? inside : outside) = middle;
            }
            all.push_back(inside * to);
        }
    }
    return all;
}

TEST(Shape, ExtentAlongADirectionIsThatOfItsFarthestPoint) {
    for (const Case& c : cases()) {
        Points points;
        const std::vector<glm::dvec3> rim = surface(c.medium);
        for (int k = 0; k < 20; ++k) {
            const vec3 direction = points.direction();
            double most = 0;
            for (const glm::dvec3 p : rim) most = std::max(most, glm::dot(p, glm::dvec3(direction)));
            const double half = half_extent_along(c.medium, direction);
            EXPECT_LE(most, half + 1e-5) << c.name;
            EXPECT_GE(most, 0.998 * half) << c.name;
            EXPECT_NEAR(half_extent_along(pack_shape(c.medium), direction), half, 1e-5) << c.name;
        }
    }
}

// No point of positive density lies outside of the box of the corners, its spheres or its distances; and the box is
// no larger than the shape is along its own axes.
TEST(Shape, BoundsHoldItAndAreTight) {
    for (const Case& c : cases()) {
        Points points;
        const shared::LocalMedium m = pack_shape(c.medium);
        const auto corner = corners(c.medium);
        vec3 low = corner[0], high = corner[0];
        for (const vec3 p : corner) low = glm::min(low, p), high = glm::max(high, p);
        const vec3 lamp = c.medium.center + 3.0F * points.direction();
        const glm::vec2 distance = distances(c.medium, lamp);
        float farthest_from_center = 0;
        for (int i = 0; i < 20000; ++i) {
            const vec3 p = points.near(c.medium, 1.2F);
            if (!(density(m, p) > 0)) continue;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(low - 1e-5F, p)) &&
                        glm::all(glm::lessThanEqual(p, high + 1e-5F)))
                << c.name;
            const float from_center = glm::distance(p, c.medium.center), from_lamp = glm::distance(p, lamp);
            farthest_from_center = std::max(farthest_from_center, from_center);
            EXPECT_LE(from_center, bounding_radius(c.medium) + 1e-5F) << c.name;
            EXPECT_LE(from_center, glsl::shape_radius(m) + 1e-5F) << c.name;
            EXPECT_GE(from_lamp, distance.x - 1e-5F) << c.name;
            EXPECT_LE(from_lamp, distance.y + 1e-5F) << c.name;
        }
        EXPECT_GE(farthest_from_center, 0.9F * bounding_radius(c.medium)) << c.name;
        for (int axis = 0; axis < 3; ++axis) {
            vec3 along(0);
            along[axis] = 1;
            along = c.medium.rotation * along;
            float reach = 0;
            for (const vec3 p : corner) reach = std::max(reach, glm::dot(p - c.medium.center, along));
            const vec3 rim = c.medium.center + along * (0.999F * reach);
            EXPECT_GT(density(m, rim), 0) << c.name << " axis " << axis;
        }
    }
}

TEST(Shape, DistancesAreThoseToTheBox) {
    const LocalMedium flat{.center = {1, 0, 0}, .half_extent = {1, 2, 3}};
    EXPECT_NEAR(distances(flat, {6, 0, 0}).x, 4, 1e-6);
    EXPECT_NEAR(distances(flat, {6, 0, 0}).y, std::sqrt(36.0 + 4 + 9), 1e-5);
    EXPECT_NEAR(distances(flat, {-3, 6, 0}).x, 5, 1e-6);  // of an edge: 3 and 4
    EXPECT_EQ(distances(flat, {1.5F, 0, 0}).x, 0);
}

// Of the box round it, the share of even points that lie inside.
TEST(Shape, VolumeIsThatOfItsPoints) {
    for (const Case& c : cases()) {
        Points points;
        constexpr int count = 40000;
        int inside = 0;
        for (int i = 0; i < count; ++i) inside += holds(c.medium, points.near(c.medium, 1.25F));
        const vec3 wide = 2.5F * c.medium.half_extent;
        const double expected = double(wide.x) * wide.y * wide.z * inside / count;
        EXPECT_NEAR(volume(pack_shape(c.medium)) / expected, 1, 0.03) << c.name;
    }
}

// Even in the shape: all inside, and in each octant, and within half of its extent, as many as there are of the
// points of the box that lie inside.
TEST(Shape, PlacesAreEvenAndStayInside) {
    for (const Case& c : cases()) {
        for (const float drift : {0.0F, 7.3F}) {
            Points points;
            const shared::LocalMedium m = pack_shape(c.medium);
            constexpr int count = 40000;
            double octant[8] = {}, inner = 0, expected_inner = 0, expected = 0;
            for (int i = 0; i < count; ++i) {
                const vec3 u = 0.5F + 0.5F * vec3(points.unit(), points.unit(), points.unit());
                const vec3 p = glsl::shape_place(m, u, drift);
                ASSERT_GE(glsl::shape_depth(m, p), -1e-5F) << c.name;
                octant[(p.x > 0) + 2 * (p.y > 0) + 4 * (p.z > 0)] += 1.0 / count;
                const auto is_inner = [&](vec3 q) { return glm::length(q / c.medium.half_extent) < 0.6F; };
                inner += is_inner(p) ? 1.0 / count : 0;
                const vec3 q = c.medium.half_extent * vec3(points.unit(), points.unit(), points.unit());
                if (!holds(c.medium, c.medium.center + c.medium.rotation * q)) continue;
                expected += 1;
                expected_inner += is_inner(q);
            }
            for (const double share : octant) EXPECT_NEAR(share, 0.125, 0.01) << c.name;
            EXPECT_NEAR(inner, expected_inner / expected, 0.015) << c.name;
        }
    }
}

TEST(Shape, DriftMovesByItsLength) {
    const vec3 u(0.5F, 0.5F, 0.125F);
    const shared::LocalMedium box = pack_shape({.shape = Shape::box, .half_extent = {2, 3, 4}});
    EXPECT_NEAR(glm::distance(glsl::shape_place(box, u, 0.5F), glsl::shape_place(box, u, 0)), 0.5, 1e-5);
    // On the equator of the ball, all round.
    const shared::LocalMedium ball = pack_shape({.half_extent = vec3(2)});
    const vec3 rim(1, 0.5F, 0.125F);
    const float all_round = 4 * std::numbers::pi_v<float>;
    EXPECT_NEAR(glm::distance(glsl::shape_place(ball, rim, all_round), glsl::shape_place(ball, rim, 0)), 0, 1e-4);
    EXPECT_NEAR(glm::distance(glsl::shape_place(ball, rim, 0.5F * all_round), glsl::shape_place(ball, rim, 0)), 4,
                1e-4);
}

}  // namespace
}  // namespace tyndall::volumetrics
