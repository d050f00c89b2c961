#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/tonemap.glsl"
TYNDALL_GLSL_END

namespace tyndall::glsl {
namespace {

TEST(Tonemap, MeteredGreyShowsAsEighteenPercent) {
    EXPECT_NEAR(tonemap(vec3(0.125f / 1.2f)).y, 0.18f, 1e-4f);
}

TEST(Tonemap, RisesFromBlackToWhite) {
    EXPECT_EQ(tonemap(vec3(0)), vec3(0));
    float last = 0;
    for (float stops = -12; stops <= 12; stops += 0.25f) {
        const float shown = tonemap(vec3(std::exp2(stops))).x;
        EXPECT_GE(shown, last);
        EXPECT_LE(shown, 1);
        last = shown;
    }
    EXPECT_GT(last, 0.99f);
    EXPECT_TRUE(std::isfinite(tonemap(vec3(65504)).x));
}

TEST(Tonemap, GreyStaysGrey) {
    for (const float level : {0.01f, 0.1f, 1.0f, 10.0f}) {
        const vec3 shown = tonemap(vec3(level));
        EXPECT_NEAR(shown.x, shown.y, 1e-6f);
        EXPECT_NEAR(shown.y, shown.z, 1e-6f);
    }
}

/// Hue angle in the plane across the grey axis, degrees.
double hue(vec3 c) {
    return std::atan2(std::sqrt(3.0) * (double{c.y} - c.z), 2.0 * c.x - c.y - c.z) * 57.2957795;
}

TEST(Tonemap, ALanternKeepsItsHueAndPalesAsItBrightens) {
    const vec3 lantern(1, 0.52f, 0.2f);
    float saturation = 1;
    for (float stops = -3; stops <= 5; ++stops) {
        const vec3 shown = tonemap(lantern * std::exp2(stops));
        EXPECT_NEAR(hue(shown), hue(lantern), 13) << stops;
        const float now = 1 - std::min({shown.x, shown.y, shown.z}) / std::max({shown.x, shown.y, shown.z});
        EXPECT_LT(now, saturation) << stops;
        saturation = now;
    }
    EXPECT_LT(saturation, 0.2f);
}

TEST(Tonemap, SrgbFollowsTheStandard) {
    EXPECT_NEAR(srgb_encode(0.0031308f), 0.04045f, 1e-5f);
    EXPECT_NEAR(srgb_encode(0.214041f), 0.5f, 1e-5f);  // IEC 61966-2-1: ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(srgb_encode(1), 1, 1e-6f);
}

}  // namespace
}  // namespace tyndall::glsl
