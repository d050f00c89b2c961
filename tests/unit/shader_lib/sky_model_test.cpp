#include <gtest/gtest.h>

#include <cmath>

#include "quadrature.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/sky_model.glsl"
TYNDALL_GLSL_END

namespace tyndall::glsl {
namespace {

vec3 at(float elevation, float azimuth = 0) {
    const float e = radians(elevation), a = radians(azimuth);
    return vec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
}

TEST(SkyModel, AirMassIsTheIntegralOfTheDensity) {
    // int_0^inf exp(-(r(s) - r0) / H) ds / H along a straight ray from r0 = x H.
    for (const double x : {800.0, 5300.0})
        for (const double cosine : {1.0, 0.5, 0.1, 0.02, 0.0, -0.01}) {
            const auto density = [&](double s) {
                const double r = std::sqrt(x * x + s * s + 2 * x * s * cosine);
                return std::exp(x - r);
            };
            const double exact = test::integrate_panels(density, 0, 12 * std::sqrt(x) + 12, 400);
            EXPECT_NEAR(sky_chapman(static_cast<float>(x), static_cast<float>(cosine)), exact, 0.16 * exact)
                << x << " " << cosine;
        }
}

TEST(SkyModel, ZenithIsInProportionToTheSunAndBlue) {
    for (const float elevation : {1.0f, 3.0f, 8.0f, 15.0f, 45.0f}) {
        const vec3 zenith = sky_radiance(vec3(0, 1, 0), at(elevation), 10000);
        EXPECT_GT(sky_luminance(zenith), 0.012f * 10000) << elevation;
        EXPECT_LT(sky_luminance(zenith), 0.08f * 10000) << elevation;
        EXPECT_GT(zenith.z, 1.5f * zenith.x) << elevation;
    }
}

TEST(SkyModel, TheHorizonUnderALowSunIsWarm) {
    const vec3 low = sky_radiance(at(2), at(3), 10000), noon = sky_radiance(at(2), at(60), 10000);
    EXPECT_GT(low.x, 3 * low.z);
    EXPECT_LT(noon.x, 1.3f * noon.z);
}

TEST(SkyModel, GrowsWithTheSunAndIsFiniteEverywhere) {
    for (float sun = -90; sun <= 90; sun += 7.5f)
        for (float up = -90; up <= 90; up += 7.5f)
            for (const float azimuth : {0.0f, 90.0f, 180.0f}) {
                const vec3 once = sky_radiance(at(up, azimuth), at(sun), 1000);
                const vec3 twice = sky_radiance(at(up, azimuth), at(sun), 2000);
                const vec3 night = sky_radiance(at(up, azimuth), at(sun), 0);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(once[c]) && once[c] >= 0) << sun << " " << up;
                    EXPECT_NEAR(twice[c] + night[c], 2 * once[c], 1e-3f * twice[c]);
                }
            }
}

TEST(SkyModel, IsContinuousWhileTheSunSets) {
    for (const vec3 d : {vec3(0, 1, 0), at(5), at(20, 120)}) {
        float last = sky_luminance(sky_radiance(d, at(12), 1000));
        for (float sun = 11.9f; sun > -12; sun -= 0.1f) {
            const float now = sky_luminance(sky_radiance(d, at(sun), 1000));
            EXPECT_NEAR(now, last, 0.06f * last + 0.05f) << sun;
            last = now;
        }
    }
}

}  // namespace
}  // namespace tyndall::glsl
