#include "reference/media.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "reference/media_ray.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/volumetrics.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::glsl {
using shared::LocalMedium;
}
TYNDALL_GLSL_BEGIN
#include "shaders/volumetrics/media/shape.glsl"
TYNDALL_GLSL_END

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Shape = Medium::Shape;

Medium medium(Shape shape, float sigma_s = 0.3f, float sigma_a = 0.2f) {
    Medium m;
    m.shape = shape;
    m.sigma_s = glm::vec3(sigma_s);
    m.sigma_a = glm::vec3(sigma_a);
    m.height_profile = shape == Shape::height;
    return m;
}

Medium sphere(glm::vec3 center, float radius, float softness = 0) {
    Medium m = medium(Shape::sphere);
    m.center = center;
    m.half_extent = glm::vec3(radius);
    m.softness = softness;
    return m;
}

Medium box(glm::vec3 center, glm::vec3 size, float softness = 0) {
    Medium m = medium(Shape::box);
    m.center = center;
    m.half_extent = 0.5f * size;
    m.softness = softness;
    return m;
}

double depth(const std::vector<Medium>& media, dvec3 origin, dvec3 direction, double begin, double end,
             bool global = true) {
    return Media(media).optical_depth(origin, direction, begin, end, global, 1e-10).x;
}

/// Many equal panels: knows nothing of edges.
double fine(const Media& media, dvec3 origin, dvec3 direction, double begin, double end, int panels = 8000) {
    return test::integrate_panels([&](double t) { return media.at(origin + t * direction).sigma_t.x; }, begin, end,
                                  panels);
}

const double sigma = double(0.3f) + double(0.2f);

TEST(ReferenceMedia, HomogeneousCountsOnlyWhenAsked) {
    const std::vector<Medium> media{medium(Shape::global)};
    EXPECT_NEAR(depth(media, dvec3(0), dvec3(0, 1, 0), 3, 10, true), 7 * sigma, 1e-12);
    EXPECT_EQ(depth(media, dvec3(0), dvec3(0, 1, 0), 3, infinity, false), 0);
    EXPECT_EQ(depth(media, dvec3(0), dvec3(0, 1, 0), 3, infinity, true), infinity);
}

TEST(ReferenceMedia, HardBoxIsItsChord) {
    const std::vector<Medium> media{box({1, 0, 0}, {2, 4, 6})};
    const dvec3 slanted = glm::normalize(dvec3(1, 0.5, 0));
    // Enters at x = 0, leaves at x = 2: y runs over 1.
    EXPECT_NEAR(depth(media, dvec3(-2, -1, 0), slanted, 0, infinity), sigma * std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(depth(media, dvec3(1, 0, 0), dvec3(0, 0, 1), 0, infinity), sigma * 3, 1e-12);
    EXPECT_NEAR(depth(media, dvec3(1, 0, 0), dvec3(0, 0, 1), 1, 2.5), sigma * 1.5, 1e-12);
    EXPECT_EQ(depth(media, dvec3(2.1, 0, 0), dvec3(0, 0, 1), 0, infinity), 0);
    EXPECT_EQ(depth(media, dvec3(4, 0, 0), dvec3(1, 0, 0), 0, infinity), 0);
}

TEST(ReferenceMedia, RotatedBox) {
    Medium m = box({0, 0, 0}, {2, 2, 2});
    m.rotation = glm::angleAxis(glm::radians(45.0f), glm::vec3(0, 1, 0));
    EXPECT_NEAR(depth({m}, dvec3(-9, 0, 0), dvec3(1, 0, 0), 0, infinity), sigma * 2 * std::sqrt(2.0), 1e-6);
    m.half_extent = {1, 1, 4};  // its long axis now points at +x +z
    const dvec3 along = glm::normalize(dvec3(1, 0, 1));
    EXPECT_NEAR(depth({m}, -9.0 * along, along, 0, infinity), sigma * 8, 1e-6);
}

TEST(ReferenceMedia, HardSphereIsItsChord) {
    const std::vector<Medium> media{sphere({0, 0, 5}, 2)};
    for (const double miss : {0.0, 0.7, 1.999})
        EXPECT_NEAR(depth(media, dvec3(miss, 0, 0), dvec3(0, 0, 1), 0, infinity),
                    sigma * 2 * std::sqrt(4 - miss * miss), 1e-9);
    EXPECT_EQ(depth(media, dvec3(2.001, 0, 0), dvec3(0, 0, 1), 0, infinity), 0);
}

TEST(ReferenceMedia, EllipsoidIsASphereOfStretchedSpace) {
    Medium m = medium(Shape::ellipsoid);
    m.half_extent = {1, 2, 3};
    const dvec3 d = glm::normalize(dvec3(0.3, 1, -2));
    const dvec3 p = dvec3(0.2, -0.1, 0.4);
    // |(p + t d) / r| = 1
    const dvec3 r(1, 2, 3), a = d / r, b = p / r;
    const double aa = glm::dot(a, a), ab = glm::dot(a, b), root = std::sqrt(ab * ab - aa * (glm::dot(b, b) - 1));
    EXPECT_NEAR(depth({m}, p, d, -100, 100), sigma * 2 * root / aa, 1e-9);
}

TEST(ReferenceMedia, HeightMediumInClosedForm) {
    Medium m = medium(Shape::height);
    m.base = 1;
    m.falloff = 4;
    const double there = std::exp(-(3.0 - 1) / 4);
    EXPECT_NEAR(depth({m}, dvec3(0, 3, 0), dvec3(0, 1, 0), 0, infinity, false), sigma * 4 * there, 1e-12);
    const dvec3 slanted = glm::normalize(dvec3(3, 4, 0));
    EXPECT_NEAR(depth({m}, dvec3(0, 3, 0), slanted, 0, infinity, false), sigma * 4 * there / 0.8, 1e-12);
    EXPECT_NEAR(depth({m}, dvec3(0, 3, 0), dvec3(1, 0, 0), 0, 10), sigma * 10 * there, 1e-12);
    EXPECT_EQ(depth({m}, dvec3(0, 3, 0), dvec3(1, 0, 0), 0, infinity), infinity);
    EXPECT_NEAR(depth({m}, dvec3(0, 3, 0), -slanted, 2, 12),
                sigma * test::integrate([&](double t) { return std::exp(-(2 - 0.8 * t) / 4); }, 2, 12), 1e-10);
}

TEST(ReferenceMedia, HeightExponentIsHeldAt60) {
    Medium m = medium(Shape::height, 1e-26f, 0);
    m.falloff = 0.1f;
    // exp(60) below y = -6, and from there up the integral of the exponential.
    const double s = double(1e-26f), H = double(0.1f), top = std::exp(60.0);
    EXPECT_NEAR(depth({m}, dvec3(0, -16, 0), dvec3(0, 1, 0), 0, infinity) / (s * top * (16 - 60 * H + H)), 1,
                1e-12);
    EXPECT_NEAR(depth({m}, dvec3(0, -16, 0), dvec3(1, 0, 0), 0, 5) / (s * top * 5), 1, 1e-12);
    EXPECT_NEAR(depth({m}, dvec3(0, 3, 0), dvec3(0, -1, 0), 0, 19) / (s * top * (16 - 60 * H + H)), 1, 1e-12);
}

TEST(ReferenceMedia, SoftRimsAgainstFineQuadrature) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    Medium flat = medium(Shape::ellipsoid);
    flat.half_extent = {1.2f, 0.5f, 2};
    flat.softness = 0.3f;
    Medium profiled = box({0, 0, 0}, {2, 3, 2}, 0.4f);
    profiled.height_profile = true;
    profiled.base = -1;
    profiled.falloff = 0.7f;
    Medium hard = box({0, 0, 0}, {2, 3, 2});
    hard.height_profile = true;
    hard.falloff = 0.7f;
    const std::vector<Medium> shapes{box({0.1f, 0, 0}, {2, 3, 1}, 0.2f),
                                     box({0, 0, 0}, {2, 3, 2}, 5),
                                     sphere({0, 0, 0.2f}, 1, 0.4f),
                                     sphere({0, 0, 0}, 1, 3),
                                     flat,
                                     profiled,
                                     hard};
    for (std::size_t k = 0; k < shapes.size(); ++k) {
        const Media media({shapes[k]});
        for (int i = 0; i < 6; ++i) {
            const dvec3 o(unit(random), unit(random), unit(random));
            const dvec3 d = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
            const double expected = fine(media, o, d, -4, 4);
            const double found = media.optical_depth(o, d, -4, 4, true, 1e-10).x;
            EXPECT_NEAR(found, expected, k == 6 ? 5e-4 : 1e-6) << k;  // the step of a hard rim costs the panels
            const MediaRay ray(media, o - 4.0 * d, d, 8, 1e-9);
            EXPECT_NEAR(ray.depth(8).x, found, 2e-9) << k;
            EXPECT_NEAR(ray.depth(4.7).x, media.optical_depth(o, d, -4, 0.7, true, 1e-10).x, 2e-9) << k;
        }
    }
}

TEST(ReferenceMedia, NoiseAgainstFineQuadrature) {
    Medium m = box({0, 0, 0}, {6, 2, 6}, 0.3f);
    m.noise_scale = 0.8f;
    m.noise_amount = 0.9f;
    m.noise_seed = 7;
    const Media media({m});
    const dvec3 d = glm::normalize(dvec3(1, 0.1, 0.4));
    const dvec3 o(-4, -0.2, -1);
    const double expected = fine(media, o, d, 0, 9);
    EXPECT_GT(expected, 0.5);
    EXPECT_NEAR(media.optical_depth(o, d, 0, infinity, false, 1e-7).x, expected, 2e-6);
    // Asked for less by a root mean square error, over many rays.
    double squares = 0;
    for (int i = 0; i < 200; ++i) {
        const dvec3 from = o + dvec3(0, 0.5 * i / 200, 0.01 * i);
        squares += std::pow(media.optical_depth(from, d, 0, infinity, false, {1e-7, 1e-3}).x -
                                media.optical_depth(from, d, 0, infinity, false, 1e-7).x,
                            2);
    }
    EXPECT_LT(std::sqrt(squares / 200), 2e-3);
    const MediaRay ray(media, o, d, infinity, 1e-7);
    EXPECT_NEAR(ray.depth(infinity).x, expected, 1e-6);
    EXPECT_NEAR(ray.depth(4).x, fine(media, o, d, 0, 4), 1e-6);
}

TEST(ReferenceMedia, NoiseIsTheEnginesBitForBit) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(-300, 300);
    const MediaNoise noise{1.3f, 0.85f, 11};
    for (const std::size_t count : {1u, 7u, 8u, 200u}) {
        std::vector<glm::vec3> points(count);
        for (glm::vec3& p : points) p = {unit(random), unit(random), unit(random)};
        std::vector<float> factors(count);
        noise.factors(points, factors);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(factors[i], glsl::media_noise(points[i], 1.3f, 0.85f, 11)) << i;
            EXPECT_EQ(factors[i], noise.factor(points[i])) << i;
        }
    }
}

TEST(ReferenceMedia, DensitiesAreTheEngines) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1.6f, 1.6f);
    for (const Shape shape : {Shape::sphere, Shape::ellipsoid, Shape::box}) {
        Medium m = medium(shape, 1, 0);
        m.center = {0.25f, -0.5f, 1};
        m.half_extent = shape == Shape::sphere ? glm::vec3(1.3f) : glm::vec3(1, 1.5f, 0.7f);
        m.softness = 0.4f;
        m.noise_scale = 0.9f;
        m.noise_amount = 0.7f;
        m.noise_seed = 3;
        m.height_profile = true;
        m.base = 0.5f;
        m.falloff = 0.8f;
        const Media media({m});
        shared::LocalMedium packed{};
        packed.extent_softness = {m.half_extent, m.softness};
        packed.sigma_a_shape.w = shape == Shape::box ? SHAPE_BOX : SHAPE_ELLIPSOID;
        for (int i = 0; i < 500; ++i) {
            const glm::vec3 p(unit(random), unit(random), unit(random));
            const float expected = glsl::shape_density(packed, p) *
                                   glsl::media_noise(p, m.noise_scale, m.noise_amount, 3) *
                                   glsl::media_height(p.y + m.center.y, m.base, m.falloff);
            EXPECT_NEAR(media.at(dvec3(p) + dvec3(m.center)).sigma_s.x, expected, 2e-5f * (1 + expected));
        }
    }
}

TEST(ReferenceMedia, OverlapAddsAndAnisotropyIsWeighedByScattering) {
    Medium a = medium(Shape::global, 0.1f, 0), b = box({0, 0, 0}, {2, 2, 2});
    a.anisotropy = 0.8f;
    b.anisotropy = -0.4f;
    b.emission = {1, 2, 3};
    const Media media({a, b});
    const MediumPoint inside = media.at(dvec3(0)), outside = media.at(dvec3(5));
    EXPECT_NEAR(inside.sigma_s.x, 0.4, 1e-7);
    EXPECT_NEAR(inside.sigma_t.x, 0.6, 1e-7);
    EXPECT_NEAR(inside.anisotropy, (0.1 * 0.8 - 0.3 * 0.4) / 0.4, 1e-6);
    EXPECT_EQ(inside.emission, dvec3(1, 2, 3));
    EXPECT_NEAR(outside.anisotropy, 0.8, 1e-7);
    EXPECT_EQ(outside.emission, dvec3(0));
}

TEST(ReferenceMedia, BreakpointsAreTheKinks) {
    const Media media({box({0, 0, 0}, {2, 2, 2}, 0.25f), sphere({0, 0, 0}, 3)});
    const std::vector<double> t = media.breakpoints(dvec3(-10, 0, 0.1), dvec3(1, 0, 0), 0, 100);
    const double chord = std::sqrt(9 - 0.01);
    for (const double kink : {10 - chord, 9.0, 9.25, 10.75, 11.0, 10 + chord})
        EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](double x) { return std::abs(x - kink) < 1e-7; })) << kink;
    EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
    EXPECT_TRUE(media.breakpoints(dvec3(-10, 0, 0), dvec3(0, 1, 0), 0, 100).empty());
}

TEST(ReferenceMedia, WhatDoesNothingIsAbsent) {
    Medium flat = sphere({0, 0, 0}, 0);
    EXPECT_TRUE(Media({}).empty());
    EXPECT_TRUE(Media({medium(Shape::global, 0, 0), flat}).empty());
    EXPECT_FALSE(Media({medium(Shape::global)}).empty());
}

TEST(ReferenceMedia, ARayEndsWhereNothingComesThrough) {
    const double dense = double(2.0f) + double(0.2f);
    const Media media({medium(Shape::global, 2, 0.2f)});
    const MediaRay ray(media, dvec3(0), dvec3(0, 0, 1), infinity, 1e-9);
    EXPECT_NEAR(ray.end(), 45 / dense, 0.1);
    EXPECT_EQ(glm::exp(-ray.depth(infinity)), dvec3(0));
}

}  // namespace
}  // namespace tyndall::reference
