#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/noise.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

glm::vec3 random_point(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> unit(-size, size);
    return {unit(random), unit(random), unit(random)};
}

TEST(Hash, IsABijectionOnASample) {
    std::set<glm::uint> seen;
    for (glm::uint i = 0; i < 100000u; ++i) {
        seen.insert(glsl::hash_uint(i * 40503u));
    }
    EXPECT_EQ(seen.size(), 100000u);
}

// Chi-square of 256 bins over 2^20 neighbouring lattice points: 255 +- 22.6; and the axes are not interchangeable.
TEST(Hash, NeighbouringLatticePointsAreUniform) {
    std::vector<int> bins(256, 0);
    for (glm::uint x = 0; x < 128u; ++x) {
        for (glm::uint y = 0; y < 128u; ++y) {
            for (glm::uint z = 0; z < 64u; ++z) {
                const float u = glsl::unit_float(glsl::hash_uvec3(glm::uvec3(x, y, z), 9u));
                ASSERT_TRUE(u >= 0.0f && u < 1.0f);
                ++bins[static_cast<std::size_t>(u * 256.0f)];
            }
        }
    }
    double chi_square = 0.0;
    for (int count : bins) {
        chi_square += (count - 4096.0) * (count - 4096.0) / 4096.0;
    }
    EXPECT_GT(chi_square, 150.0);
    EXPECT_LT(chi_square, 360.0);
    EXPECT_NE(glsl::hash_uvec3(glm::uvec3(1, 2, 3), 9u), glsl::hash_uvec3(glm::uvec3(3, 2, 1), 9u));
    EXPECT_NE(glsl::hash_uvec3(glm::uvec3(1, 2, 3), 9u), glsl::hash_uvec3(glm::uvec3(1, 2, 3), 10u));
    EXPECT_LT(glsl::unit_float(0xffffffffu), 1.0f);
}

TEST(GradientNoise, RangeMeanAndSpread) {
    std::mt19937 random(1);
    double sum = 0.0, squares = 0.0, low = 0.0, high = 0.0;
    const int count = 400000;
    for (int i = 0; i < count; ++i) {
        const double n = glsl::gradient_noise(random_point(random, 500.0f), 3u);
        sum += n;
        squares += n * n;
        low = std::min(low, n);
        high = std::max(high, n);
    }
    EXPECT_NEAR(sum / count, 0.0, 3e-3);
    EXPECT_NEAR(std::sqrt(squares / count), 0.27, 0.02);
    EXPECT_GT(low, -1.04);
    EXPECT_LT(high, 1.04);
}

TEST(GradientNoise, IsZeroAtTheLatticeAndContinuousAcrossIt) {
    std::mt19937 random(2);
    const float step = 1e-3f;
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 cell = glm::floor(random_point(random, 50.0f));
        EXPECT_EQ(glsl::gradient_noise(cell, 1u), 0.0f);
        const glm::vec3 p = glm::fract(random_point(random, 50.0f));
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 below = cell + p;
            below[axis] = cell[axis] - step;
            glm::vec3 at = below;
            at[axis] = cell[axis];
            glm::vec3 above = below;
            above[axis] = cell[axis] + step;
            const float n = glsl::gradient_noise(at, 1u);
            const float left = (n - glsl::gradient_noise(below, 1u)) / step;
            const float right = (glsl::gradient_noise(above, 1u) - n) / step;
            ASSERT_NEAR(left, right, 0.06f) << "the slope jumps at a cell's face";
            ASSERT_LT(std::abs(left), 4.0f);
        }
    }
}

TEST(FbmNoise, RangeMeanAndSeeds) {
    std::mt19937 random(4);
    double sum = 0.0, squares = 0.0, product = 0.0;
    const int count = 200000;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 p = random_point(random, 300.0f);
        const double a = glsl::fbm_noise(p, 4, 1u);
        const double b = glsl::fbm_noise(p, 4, 1000u);
        ASSERT_TRUE(a >= 0.0 && a <= 1.0);
        sum += a;
        squares += (a - 0.5) * (a - 0.5);
        product += (a - 0.5) * (b - 0.5);
    }
    EXPECT_NEAR(sum / count, 0.5, 2e-3);
    EXPECT_NEAR(std::sqrt(squares / count), 0.083, 0.01);
    EXPECT_NEAR(product / squares, 0.0, 0.02) << "seeds are correlated";
}

TEST(FbmNoise, DoesNotRepeat) {
    for (float period : {16.0f, 64.0f, 256.0f, 1024.0f}) {
        double difference = 0.0;
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 p(0.37f * static_cast<float>(i), 0.5f, 0.25f);
            difference += std::abs(glsl::fbm_noise(p, 4, 1u) - glsl::fbm_noise(p + glm::vec3(period, 0, 0), 4, 1u));
        }
        EXPECT_GT(difference / 100.0, 0.03) << period;
    }
}

}  // namespace
