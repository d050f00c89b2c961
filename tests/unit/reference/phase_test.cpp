#include "reference/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::reference {
namespace {

using Phase = double (*)(double, double);
constexpr double pi = std::numbers::pi;

/// Over the sphere, in x = -log(1.0001 - cos) and its mirror image, which spread the peaks out.
double over_sphere(Phase phase, double g, double power_of_cosine) {
    const auto half = [&](double side) {
        constexpr double offset = 1e-7;
        const auto f = [&](double x) {
            const double below_one = std::exp(x) - offset;
            const double cosine = side * (1 - below_one);
            return 2 * pi * phase(g, cosine) * std::pow(cosine, power_of_cosine) * (below_one + offset);
        };
        return test::integrate(f, std::log(offset), std::log(1 + offset), 1e-12);
    };
    return half(1) + half(-1);
}

TEST(ReferencePhase, IntegratesToOne) {
    for (const Phase phase : {&henyey_greenstein, &schlick, &cornette_shanks})
        for (const double g : {-0.999, -0.95, -0.4, 0.0, 0.3, 0.76, 0.93, 0.95, 0.999, 1.0})
            EXPECT_NEAR(over_sphere(phase, g, 0), 1, 1e-8) << g;
}

TEST(ReferencePhase, MeanCosineOfHenyeyGreensteinIsG) {
    for (const double g : {-0.9, -0.2, 0.0, 0.5, 0.99}) EXPECT_NEAR(over_sphere(&henyey_greenstein, g, 1), g, 1e-8);
}

TEST(ReferencePhase, MeanCosineOfCornetteShanks) {
    for (const double g : {-0.9, -0.2, 0.0, 0.5, 0.99})
        EXPECT_NEAR(over_sphere(&cornette_shanks, g, 1), 3 * g * (4 + g * g) / (5 * (2 + g * g)), 1e-8);
}

TEST(ReferencePhase, DropletsIntegrateToOne) {
    const Phase phase = [](double diameter, double cosine) { return droplets(diameter, cosine); };
    for (const double diameter : {5.0, 10.0, 20.0, 50.0}) {
        EXPECT_NEAR(over_sphere(phase, diameter, 0), 1, 1e-8) << diameter;
        for (const double cosine : {-1.0, -0.5, 0.0, 0.5, 0.99})
            EXPECT_LT(droplets(diameter, cosine), droplets_peak(diameter));
    }
    for (const double cosine : {-1.0, 0.2, 1.0}) {
        EXPECT_DOUBLE_EQ(draine(0.4, 0, cosine), henyey_greenstein(0.4, cosine));
        EXPECT_DOUBLE_EQ(draine(0, 1, cosine), rayleigh(cosine));
    }
}

TEST(ReferencePhase, RayleighIsCornetteShanksWithoutAnisotropy) {
    for (const double cosine : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
        EXPECT_DOUBLE_EQ(rayleigh(cosine), 3 / (16 * pi) * (1 + cosine * cosine));
        EXPECT_DOUBLE_EQ(cornette_shanks(0, cosine), rayleigh(cosine));
        EXPECT_LE(rayleigh(cosine), rayleigh_peak());
    }
}

TEST(ReferencePhase, OfTheSettings) {
    using Kind = ParticlePhase::Kind;
    for (const double g : {-0.7, 0.0, 0.4, 0.95})
        for (const double cosine : {-1.0, -0.3, 0.6, 1.0}) {
            EXPECT_EQ(ParticlePhase{}(g, cosine), henyey_greenstein(g, cosine));
            EXPECT_EQ(ParticlePhase{Kind::schlick}(g, cosine), schlick(g, cosine));
            EXPECT_EQ(ParticlePhase{Kind::cornette_shanks}(g, cosine), cornette_shanks(g, cosine));
            const ParticlePhase two{Kind::double_henyey_greenstein, -0.3, 0.25};
            EXPECT_DOUBLE_EQ(two(g, cosine),
                             0.75 * henyey_greenstein(g, cosine) + 0.25 * henyey_greenstein(-0.3, cosine));
            const ParticlePhase drops{.kind = Kind::hg_draine, .droplet_diameter = 20};
            EXPECT_EQ(drops(g, cosine), droplets(20, cosine));
            for (const ParticlePhase& p : {ParticlePhase{}, {Kind::schlick}, {Kind::cornette_shanks}, two, drops})
                EXPECT_LE(p(g, cosine), p.peak(g) * (1 + 1e-12));
        }
}

TEST(ReferencePhase, SchlickIsCloseToHenyeyGreenstein) {
    for (const double cosine : {-1.0, -0.3, 0.4, 0.8})
        EXPECT_NEAR(schlick(0.4, cosine), henyey_greenstein(0.4, cosine), 0.02);
    EXPECT_DOUBLE_EQ(schlick(0, 0.3), 1 / (4 * pi));
    EXPECT_DOUBLE_EQ(henyey_greenstein(0, 0.3), 1 / (4 * pi));
}

TEST(ReferencePhase, PeakIsForwardForPositiveG) {
    for (const double g : {0.3, 0.9, 0.999}) {
        EXPECT_DOUBLE_EQ(henyey_greenstein(g, 1), henyey_greenstein_peak(-g));
        EXPECT_DOUBLE_EQ(schlick(-g, -1), schlick_peak(g));
        EXPECT_GT(henyey_greenstein(g, 1), henyey_greenstein(g, -1));
        EXPECT_GT(schlick(g, 1), schlick(g, 0.99));
    }
}

}  // namespace
}  // namespace tyndall::reference
