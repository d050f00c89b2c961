#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/pack.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

// Distance of the numbers of 11 significant bits around x; multiples of 2^-24 below 2^-14.
double half_spacing(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, std::max(exponent - 11, -24));
}

TEST(RoundToHalf, IsTheNearest) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-7.0, 4.8);
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<float>(std::pow(10.0, exponent(random)));
        const double spacing = half_spacing(x);
        const glm::vec4 rounded = glsl::round_to_half(glm::vec4(x, -x, 0.0f, 1.0f));
        ASSERT_LE(std::abs(double{rounded.x} - x), 0.5 * spacing);
        ASSERT_EQ(std::fmod(rounded.x, spacing), 0.0);
        ASSERT_EQ(rounded.y, -rounded.x);
        ASSERT_EQ(rounded.z, 0.0f);
        ASSERT_EQ(rounded.w, 1.0f);
    }
}

TEST(RoundToHalf, LargeValuesStayFinite) {
    const glm::vec4 rounded = glsl::round_to_half(glm::vec4(7e4f, -1e30f, INFINITY, 65519.0f));
    EXPECT_EQ(rounded, glm::vec4(65504.0f, -65504.0f, 65504.0f, 65504.0f));
}

// A moving average stored in half precision reaches its target to within the rounding of one step.
TEST(RoundToHalf, MovingAverageDoesNotStallFarFromItsTarget) {
    float average = 0.0f;
    for (int i = 0; i < 2000; ++i) {
        average = glsl::round_to_half(glm::vec4(average + 0.05f * (1.0f - average))).x;
    }
    EXPECT_GT(average, 1.0f - 0.5f / 2048.0f / 0.05f - 1e-6f);
}

}  // namespace
