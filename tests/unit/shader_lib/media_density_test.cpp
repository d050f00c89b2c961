#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/media_density.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;
using glm::vec3;

TEST(MediaRim, RisesToOneOverTheSoftness) {
    EXPECT_EQ(glsl::soft_rim(0.0f, 0.5f), 0.0f);
    EXPECT_NEAR(glsl::soft_rim(0.125f, 0.5f), 0.25f, 1e-6f);
    EXPECT_EQ(glsl::soft_rim(0.5f, 0.5f), 1.0f);
    EXPECT_EQ(glsl::soft_rim(3.0f, 0.5f), 1.0f);
    EXPECT_EQ(glsl::soft_rim(-1.0f, 0.5f), 0.0f);
    EXPECT_EQ(glsl::soft_rim(0.001f, 0.0f), 1.0f);
    EXPECT_EQ(glsl::soft_rim(-0.001f, 0.0f), 0.0f);
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
