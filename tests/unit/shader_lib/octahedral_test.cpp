#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/octahedral.glsl"
TYNDALL_GLSL_END

namespace tyndall::glsl {
namespace {

float unorm16(float v) {
    return std::round(v * 65535.0f) / 65535.0f;
}

/// Degrees between a direction and what comes back from 16 bits a channel.
double error_of(vec3 n) {
    const vec2 e = octahedral_encode(n);
    EXPECT_TRUE(e.x >= 0 && e.x <= 1 && e.y >= 0 && e.y <= 1) << e.x << " " << e.y;
    const vec3 back = octahedral_decode(vec2(unorm16(e.x), unorm16(e.y)));
    return std::atan2(double{length(cross(n, back))}, double{dot(n, back)}) * 57.2957795;
}

TEST(Octahedral, KeepsDirectionsWithinTheStatedError) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 20000; ++i)
        EXPECT_LT(error_of(normalize(vec3(normal(random), normal(random), normal(random)))), 0.005);
}

TEST(Octahedral, KeepsAxesAndTheFold) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            vec3 n(0);
            n[axis] = sign;
            EXPECT_LT(error_of(n), 0.005) << axis << " " << sign;
        }
    for (const vec3 n : {vec3(1, 1, 0), vec3(-1, 1, -1e-6f), vec3(0.3f, -0.7f, 0)})
        EXPECT_LT(error_of(normalize(n)), 0.005);
}

}  // namespace
}  // namespace tyndall::glsl
