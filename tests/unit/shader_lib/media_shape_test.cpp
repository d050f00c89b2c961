#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/media_shape.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;
using glm::vec3;

TEST(MediaShape, SphereRamp) {
    EXPECT_EQ(glsl::sphere_density(vec3(0.0f), 2.0f, 0.5f), 1.0f);
    EXPECT_EQ(glsl::sphere_density(vec3(1.5f, 0.0f, 0.0f), 2.0f, 0.5f), 1.0f);
    EXPECT_NEAR(glsl::sphere_density(vec3(0.0f, 1.875f, 0.0f), 2.0f, 0.5f), 0.25f, 1e-6f);
    EXPECT_EQ(glsl::sphere_density(vec3(0.0f, 0.0f, -2.0f), 2.0f, 0.5f), 0.0f);
    EXPECT_EQ(glsl::sphere_density(vec3(3.0f), 2.0f, 0.5f), 0.0f);
    // Softer than the radius: the centre does not reach 1.
    EXPECT_NEAR(glsl::sphere_density(vec3(0.0f), 2.0f, 4.0f), 0.5f, 1e-6f);
}

TEST(MediaShape, HardRimIsAStep) {
    for (int shape : {glsl::MEDIA_SPHERE, glsl::MEDIA_ELLIPSOID, glsl::MEDIA_BOX}) {
        EXPECT_EQ(glsl::media_shape_density(shape, vec3(0.999f, 0.0f, 0.0f), vec3(1.0f), 0.0f), 1.0f) << shape;
        EXPECT_EQ(glsl::media_shape_density(shape, vec3(1.001f, 0.0f, 0.0f), vec3(1.0f), 0.0f), 0.0f) << shape;
        EXPECT_EQ(glsl::media_shape_density(shape, vec3(0.0f), vec3(1.0f), 0.0f), 1.0f) << shape;
    }
}

TEST(MediaShape, BoxRampIsTheDistanceToTheNearestFace) {
    const vec3 half(2.0f, 1.0f, 3.0f);
    EXPECT_EQ(glsl::box_density(vec3(0.0f), half, 0.5f), 1.0f);
    EXPECT_NEAR(glsl::box_density(vec3(1.9f, 0.0f, 0.0f), half, 0.5f), 0.2f, 1e-6f);
    EXPECT_NEAR(glsl::box_density(vec3(-1.9f, 0.95f, -2.8f), half, 0.5f), 0.1f, 1e-6f);
    EXPECT_EQ(glsl::box_density(vec3(0.0f, 0.0f, 3.1f), half, 0.5f), 0.0f);
}

TEST(MediaShape, EllipsoidWithEqualRadiiIsTheSphere) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-2.2f, 2.2f);
    for (int i = 0; i < 1000; ++i) {
        const vec3 p(unit(random), unit(random), unit(random));
        EXPECT_NEAR(glsl::ellipsoid_density(p, vec3(2.0f), 0.7f), glsl::sphere_density(p, 2.0f, 0.7f), 2e-6f);
    }
    EXPECT_EQ(glsl::ellipsoid_density(vec3(0.0f), vec3(1.0f, 2.0f, 3.0f), 0.5f), 1.0f);
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

TEST(MediaShape, EllipsoidDepthIsCloseToTheDistance) {
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
            // A ramp as wide as the smallest radius, 1, returns the depth itself.
            const double read = glsl::ellipsoid_density(vec3(p), vec3(radii), 1.0f);
            ASSERT_GT(read / depth, 1.0 - 1e-3);
            ASSERT_LT(read / depth, 1.0 + bound.too_large);
        }
    }
}

TEST(MediaNoise, KeepsTheMeanAndNeverGoesNegative) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-200.0f, 200.0f);
    for (float amount : {0.3f, 1.0f}) {
        double sum = 0.0, squares = 0.0;
        const int count = 200000;
        for (int i = 0; i < count; ++i) {
            const float n = glsl::media_noise(vec3(unit(random), unit(random), unit(random)), 1.5f, amount, 1u);
            ASSERT_TRUE(n >= 1.0f - amount && n <= 1.0f + amount);
            sum += n;
            squares += (n - 1.0) * (n - 1.0);
        }
        EXPECT_NEAR(sum / count, 1.0, 0.005);
        EXPECT_GT(std::sqrt(squares / count), 0.4 * amount) << "the noise does not show";
    }
    EXPECT_EQ(glsl::media_noise(vec3(1.0f), 1.5f, 0.0f, 1u), 1.0f);
}

TEST(MediaNoise, ScaleIsALength) {
    const vec3 p(0.3f, 1.7f, -2.2f);
    EXPECT_EQ(glsl::media_noise(p, 1.0f, 0.8f, 5u), glsl::media_noise(4.0f * p, 4.0f, 0.8f, 5u));
}

TEST(MediaHeight, IsTheExponentialOrNothing) {
    EXPECT_NEAR(glsl::media_height(3.4f, 1.0f, 1.2f), std::exp(-2.0), 1e-6);
    EXPECT_NEAR(glsl::media_height(-0.2f, 1.0f, 1.2f), std::exp(1.0), 1e-5);
    EXPECT_EQ(glsl::media_height(7.0f, 1.0f, 0.0f), 1.0f);
}

}  // namespace
