#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "reference/brdf.h"

namespace tyndall::reference {
namespace {

constexpr double pi = std::numbers::pi;

Surface surface(dvec3 base, double metallic, double roughness, double f0 = 0.04) {
    Surface s{};
    s.geometric_normal = s.normal = {0, 0, 1};
    s.base_color = base;
    s.metallic = metallic;
    s.roughness = roughness;
    s.occlusion = 1;
    s.dielectric_f0 = f0;
    return s;
}

dvec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// int f(l) dl over the hemisphere, by equal solid angles. Good for lobes of roughness from 0.3 on.
template <class F>
double hemisphere(F f) {
    constexpr int n = 300;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) sum += f(direction((i + 0.5) / n, 2 * pi * (j + 0.5) / n));
    return sum * 2 * pi / (n * n);
}

TEST(SurfaceBrdf, HeadOnByHand) {
    const dvec3 n(0, 0, 1);
    // Roughness 1: D = 1 / pi, visibility 1 / 4. Roughness 0.5, alpha 1/4: D = 16 / pi.
    EXPECT_NEAR(reflected(surface(dvec3(0.5), 0, 1), n, n).x, 0.96 * 0.5 / pi + 0.04 / (4 * pi), 1e-12);
    EXPECT_NEAR(reflected(surface(dvec3(0.5), 0, 0.5), n, n).x, 0.96 * 0.5 / pi + 0.04 * 4 / pi, 1e-12);
    EXPECT_NEAR(reflected(surface(dvec3(0.5), 1, 0.5), n, n).x, 0.5 * 4 / pi, 1e-12);
    // Below roughness 0.045 nothing changes.
    EXPECT_EQ(reflected(surface(dvec3(0.5), 1, 0), n, n), reflected(surface(dvec3(0.5), 1, 0.045), n, n));
}

TEST(SurfaceBrdf, AtSixtyDegreesByHand) {
    // l and v at 60 degrees on opposite sides: h = n, v.h = 1/2, and for roughness 1 the visibility is
    // 1 / (2 (1/2 + 1/2)).
    const dvec3 v = direction(0.5, 0), l = direction(0.5, pi);
    const double fresnel = 0.04 + 0.96 / 32;
    EXPECT_NEAR(reflected(surface(dvec3(0.5), 0, 1), v, l).x, 0.5 * ((1 - fresnel) * 0.5 / pi + fresnel / pi * 0.5),
                1e-12);
    // f0 of 1%: the lobe has half its height at grazing.
    const double faded = 0.01 + 0.49 / 32;
    EXPECT_NEAR(reflected(surface(dvec3(0.5), 0, 1, 0.01), v, l).x,
                0.5 * ((1 - faded) * 0.5 / pi + faded / pi * 0.5), 1e-12);
}

TEST(SurfaceBrdf, IsReciprocal) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.02, 1);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 a = direction(unit(random), 7 * unit(random)), b = direction(unit(random), 7 * unit(random));
        const Surface s =
            surface({unit(random), unit(random), unit(random)}, unit(random), unit(random), 0.1 * unit(random));
        const dvec3 ab = reflected(s, a, b) / b.z, ba = reflected(s, b, a) / a.z;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(ab[c], ba[c], 1e-9 * (1 + ab[c]));
    }
}

TEST(SurfaceBrdf, MetalsReflectNoMoreThanTheyReceive) {
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double n_dot_v : {0.1, 0.4, 0.8, 1.0}) {
            const Surface s = surface(dvec3(1), 1, roughness);
            const dvec3 v = direction(n_dot_v, 0.4);
            const double all = hemisphere([&](dvec3 l) { return reflected(s, v, l).x; });
            EXPECT_LE(all, 1.001) << roughness << " " << n_dot_v;
        }
    // Microfacets that face nearly one way lose little between each other.
    const dvec3 v = direction(0.8, 0.4), n(0, 0, 1);
    EXPECT_NEAR(hemisphere([&](dvec3 l) { return reflected(surface(dvec3(1), 1, 0.3), v, l).x; }), 1, 0.02);
    // Roughness 1 head-on: int c / (1 + c) dc = 1 - ln 2.
    EXPECT_NEAR(hemisphere([&](dvec3 l) { return reflected(surface(dvec3(1), 1, 1), n, l).x; }), 1 - std::log(2),
                1e-5);
}

TEST(SurfaceBrdf, WithoutReflectanceItIsLambert) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0.01, 1);
    for (int i = 0; i < 200; ++i) {
        const dvec3 v = direction(unit(random), 7 * unit(random)), l = direction(unit(random), 7 * unit(random));
        EXPECT_NEAR(reflected(surface(dvec3(0.7), 0, unit(random), 0), v, l).x, 0.7 / pi * l.z, 1e-12);
    }
}

TEST(SurfaceBrdf, NothingFromBelowAndFiniteFromBehind) {
    const Surface s = surface(dvec3(0.7), 0.5, 0.2);
    EXPECT_EQ(reflected(s, {0, 0, 1}, direction(-0.01, 1)), dvec3(0));
    const dvec3 behind = reflected(s, direction(-0.3, 0), direction(1e-6, 3));
    EXPECT_TRUE(std::isfinite(behind.x) && behind.x >= 0);
}

TEST(SurfaceBrdf, SamplesOfTheLobeSumToItsIntegral) {
    for (const double roughness : {0.4, 0.7, 1.0})
        for (const double n_dot_v : {0.3, 0.9}) {
            const dvec3 v = direction(n_dot_v, 1);
            const Brdf brdf(surface({1, 0.5, 0.2}, 1, roughness), v);
            // An uneven sky, so that directions matter.
            const auto light = [](dvec3 l) { return 1 + l.x + 0.5 * l.y * l.z; };
            const double exact =
                hemisphere([&](dvec3 l) { return brdf.specular(l).y * std::max(l.z, 0.0) * light(l); });
            constexpr int n = 200;
            double sum = 0;
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const double azimuth = 2 * pi * (j + 0.5) / n;
                    const auto [l, weight] = brdf.sample((i + 0.5) / n, std::cos(azimuth), std::sin(azimuth));
                    sum += weight.y * light(l);
                }
            EXPECT_NEAR(sum / (n * n), exact, 2e-3 * exact) << roughness << " " << n_dot_v;
        }
}

}  // namespace
}  // namespace tyndall::reference
