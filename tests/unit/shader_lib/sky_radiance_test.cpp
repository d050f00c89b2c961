#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/sky_radiance.glsl"
TYNDALL_GLSL_END

namespace tyndall::glsl {
namespace {

/// The integral over the sphere of a function of the angle to an axis, by the midpoint rule in its cosine.
template <class F>
double over_sphere(F f) {
    constexpr int n = 200000;
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += f(-1 + (i + 0.5) * 2 / n);
    return 4 * std::numbers::pi * sum / n;
}

TEST(PhaseMeanCosine, IsTheMeanOverTheSphere) {
    for (const float g : {-0.9f, -0.3f, -0.05f, 0.0f, 0.12f, 0.2f, 0.6f, 0.9f}) {
        for (const int kind : {PHASE_ISOTROPIC, PHASE_HENYEY_GREENSTEIN, PHASE_SCHLICK, PHASE_CORNETTE_SHANKS})
            EXPECT_NEAR(phase_mean_cosine(kind, g),
                        over_sphere([&](double c) { return c * double(phase(kind, g, float(c))); }), 2e-5)
                << kind << " " << g;
        for (const float alpha : {0.0f, 1.0f, 20.0f})
            EXPECT_NEAR(phase_mean_cosine_draine(g, alpha),
                        over_sphere([&](double c) { return c * double(phase_draine(g, alpha, float(c))); }), 2e-5)
                << alpha << " " << g;
    }
}

/// Light of radiance 1 from all directions within the half angle `alpha` of an axis.
SkyRadiance cap(double alpha, vec3 axis) {
    const double share = (1 - std::cos(alpha)) / 2;
    const float slope = float(3 * share * (1 + std::cos(alpha)) / 2);
    return {vec3(float(share)), slope * axis, slope * axis, slope * axis};
}

/// Sum over a cap of weight(direction), per 4 pi.
template <class F>
double over_cap(double alpha, vec3 axis, F weight) {
    const dvec3 side = normalize(cross(dvec3(axis), dvec3(0.3, 0.5, -0.8))), other = cross(dvec3(axis), side);
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double c = 1 - (1 - std::cos(alpha)) * (i + 0.5) / n, s = std::sqrt(1 - c * c);
            const double phi = 2 * std::numbers::pi * (k + 0.5) / n;
            sum += weight(c * dvec3(axis) + s * (std::cos(phi) * side + std::sin(phi) * other));
        }
    return sum / (double(n) * n) * (1 - std::cos(alpha)) / 2;
}

constexpr vec3 axis(0.6f, 0.8f, 0);
const vec3 directions[] = {axis, -axis, {0, 0, 1}, normalize(vec3(1, 1, 1)), normalize(vec3(-0.2f, 0.4f, 0.9f))};

double scattered_truth(double alpha, vec3 d, float g) {
    return over_cap(alpha, axis, [&](dvec3 w) {
        return 4 * std::numbers::pi * double(phase_henyey_greenstein(g, float(dot(w, dvec3(d)))));
    });
}

TEST(SkyRadianceTest, LightOfACapIsScatteredAsItsSumOverTheCap) {
    for (const vec3 d : directions) {
        // Half spheres and all-round light: bands 0 and 1 are all that matters up to g^3.
        EXPECT_NEAR(sky_scattered(cap(std::numbers::pi / 2, axis), d, 0.3f).x,
                    scattered_truth(std::numbers::pi / 2, d, 0.3f), 0.012);
        EXPECT_NEAR(sky_scattered(cap(std::numbers::pi, axis), d, 0.8f).x, 1, 1e-5);
        // A lamp's worth of sky: the phase function itself.
        for (const float g : {-0.5f, 0.0f, 0.8f}) {
            const double truth = scattered_truth(0.02, d, g);
            EXPECT_NEAR(sky_scattered(cap(0.02, axis), d, g).x, truth, 0.02 * truth) << g;
        }
        // A window.
        const double truth = scattered_truth(0.4, d, 0.6f), mean = (1 - std::cos(0.4)) / 2;
        EXPECT_NEAR(sky_scattered(cap(0.4, axis), d, 0.6f).x, truth, 0.15 * truth + 0.05 * mean);
    }
}

// The mean over all view directions is the mean radiance, whatever g: nothing is made or lost where nothing is cut
// off.
TEST(SkyRadianceTest, ScatteringKeepsTheLight) {
    for (const double alpha : {0.1, 0.7, 1.5, 2.5})
        for (const float g : {0.2f, 0.6f}) {
            const SkyRadiance sky = cap(alpha, vec3(0, 1, 0));
            const double all = over_sphere([&](double c) {
                return double(sky_scattered(sky, vec3(float(std::sqrt(1 - c * c)), float(c), 0), g).x);
            });
            EXPECT_NEAR(all / (4 * std::numbers::pi), sky.mean.x, 0.01 * double(sky.mean.x)) << alpha << " " << g;
        }
}

TEST(SkyRadianceTest, IrradianceOfACap) {
    for (const double alpha : {0.05, 0.5, 1.0, std::numbers::pi / 2, std::numbers::pi})
        for (const vec3 n : directions) {
            const double truth =
                over_cap(alpha, axis, [&](dvec3 w) { return 4 * std::max(dot(w, dvec3(n)), 0.0); });
            // Of a point of light bands 0 to 2 leave 1/16 on its side and 3/8 across of what falls on it.
            EXPECT_NEAR(sky_irradiance(cap(alpha, axis), n).x, truth, 0.4 * (1 - std::cos(alpha)) / 2 + 1e-5)
                << alpha;
        }
}

}  // namespace
}  // namespace tyndall::glsl
