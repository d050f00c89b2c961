#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shaders/lib/glm_subset.h"
#include "tests/unit/shader_lib/quadrature.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/phase.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

constexpr double kPi = 3.14159265358979323846;
const std::vector<float> kAnisotropies{-0.99f, -0.95f, -0.9f, -0.5f, -0.1f, 0.0f, 0.1f, 0.5f, 0.9f, 0.95f, 0.99f};

// Over the sphere. With 1 - s cos_theta = exp(-v), v from -ln 2 up, a peak of any width is resolved, and the
// distance from the peak reaches the function with all its digits.
template <typename F>
double sphere_integral(const F& f, double sign) {
    const auto over_v = [&](double v) {
        const double from_peak = std::exp(-v);
        return 2.0 * kPi * f(sign * (1.0 - from_peak)) * from_peak;
    };
    return test::integrate_panels(over_v, -std::log(2.0), 40.0, 500);
}

double hg_exact(double g, double c) {
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * c, 1.5));
}

double eval(int kind, float g, double c) {
    return glsl::phase(kind, g, static_cast<float>(c));
}

TEST(Phase, IntegratesToOneOverTheSphere) {
    for (int kind :
         {glsl::PHASE_ISOTROPIC, glsl::PHASE_HENYEY_GREENSTEIN, glsl::PHASE_SCHLICK, glsl::PHASE_CORNETTE_SHANKS}) {
        for (float g : kAnisotropies) {
            const double total = sphere_integral([&](double c) { return eval(kind, g, c); }, g < 0 ? -1 : 1);
            EXPECT_NEAR(total, 1.0, 1e-4) << "kind " << kind << " g " << g;
        }
    }
}

TEST(Phase, MeanCosineOfHenyeyGreensteinIsG) {
    for (float g : kAnisotropies) {
        const double mean = sphere_integral([&](double c) { return c * eval(glsl::PHASE_HENYEY_GREENSTEIN, g, c); },
                                            g < 0 ? -1 : 1);
        EXPECT_NEAR(mean, g, 1e-4);
    }
}

TEST(Phase, HenyeyGreensteinMatchesTheFormulaInDoublePrecision) {
    for (float g : {-0.999f, -0.9f, -0.3f, 0.0f, 0.3f, 0.9f, 0.99f, 0.999f}) {
        for (double c = -1.0; c <= 1.0; c += 1.0 / 512) {
            const double expected = hg_exact(g, c);
            EXPECT_NEAR(eval(glsl::PHASE_HENYEY_GREENSTEIN, g, c) / expected, 1.0, 2e-4) << "g " << g << " c " << c;
        }
    }
}

// Of <cos> and <cos^3> of Henyey-Greenstein, g and (3 g + 2 g^3) / 5.
TEST(Phase, MeanCosineOfCornetteAndShanks) {
    for (float g : kAnisotropies) {
        const double mean =
            sphere_integral([&](double c) { return c * eval(glsl::PHASE_CORNETTE_SHANKS, g, c); }, g < 0 ? -1 : 1);
        EXPECT_NEAR(mean, 3 * g * (4 + g * g) / (5 * (2 + g * g)), 1e-4) << g;
    }
}

TEST(Phase, CornetteAndShanksLiesBetweenRayleighAndHenyeyGreenstein) {
    for (double c : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
        EXPECT_NEAR(eval(glsl::PHASE_CORNETTE_SHANKS, 0.0f, c), 3 / (16 * kPi) * (1 + c * c), 1e-8);
        const double expected = hg_exact(0.6f, c) * 1.5 * (1 + c * c) / (2 + 0.36);
        EXPECT_NEAR(eval(glsl::PHASE_CORNETTE_SHANKS, 0.6f, c) / expected, 1, 1e-6);
    }
    EXPECT_NEAR(eval(glsl::PHASE_CORNETTE_SHANKS, 0.999f, 1.0) / hg_exact(0.999, 1), 1, 1e-3);
}

TEST(Phase, RayleighIsNormalisedAndSymmetric) {
    const auto p = [](double c) { return double{glsl::phase_rayleigh(static_cast<float>(c))}; };
    EXPECT_NEAR(sphere_integral(p, 1), 1, 1e-6);
    EXPECT_NEAR(sphere_integral([&](double c) { return c * p(c); }, 1), 0, 1e-6);
    for (double c : {0.0, 0.3, 0.9, 1.0}) EXPECT_EQ(p(c), p(-c));
    EXPECT_NEAR(p(1), 2 * p(0), 1e-8);
}

TEST(Phase, TwoLobesAreNormalisedAndMixTheirMeans) {
    for (float g : kAnisotropies) {
        for (float back : {0.0f, -0.3f, -0.9f}) {
            for (float weight : {0.0f, 0.2f, 1.0f}) {
                const auto p = [&](double c) {
                    return double{glsl::phase(glsl::PHASE_DOUBLE_HENYEY_GREENSTEIN, g, back, 0, weight,
                                              static_cast<float>(c))};
                };
                // Peaks at both ends: both halves of the sphere from their ends inwards.
                const auto sphere = [](const auto& f) {
                    const auto over_v = [&](double v) {
                        const double from_end = std::exp(-v);
                        return 2 * kPi * from_end * (f(1 - from_end) + f(from_end - 1));
                    };
                    return test::integrate_panels(over_v, 0, 40, 500);
                };
                const auto moment = [&](double c) { return c * p(c); };
                EXPECT_NEAR(sphere(p), 1, 1e-4) << g << ' ' << back << ' ' << weight;
                EXPECT_NEAR(sphere(moment), g * (1 - weight) + back * weight, 1e-4);
                for (double c : {-1.0, 0.2, 1.0}) {
                    const auto lobe = [&](float of) { return eval(glsl::PHASE_HENYEY_GREENSTEIN, of, c); };
                    EXPECT_NEAR(p(c), (1 - double{weight}) * lobe(g) + weight * lobe(back), 1e-6 * p(c));
                }
            }
        }
    }
}

// Of <cos> and <cos^3> of Henyey-Greenstein, too.
TEST(Phase, DraineIsNormalisedWithTheMeanCosineStated) {
    for (float g : {-0.9f, 0.0f, 0.5f, 0.7f}) {
        for (float alpha : {0.0f, 1.0f, 30.0f}) {
            const auto p = [&](double c) { return double{glsl::phase_draine(g, alpha, static_cast<float>(c))}; };
            const double g2 = double{g} * g;
            EXPECT_NEAR(sphere_integral(p, g < 0 ? -1 : 1), 1, 1e-4) << g << ' ' << alpha;
            EXPECT_NEAR(sphere_integral([&](double c) { return c * p(c); }, g < 0 ? -1 : 1),
                        g * (1 + alpha * (3 + 2 * g2) / 5) / (1 + alpha * (1 + 2 * g2) / 3), 1e-4);
        }
    }
    for (double c : {-1.0, 0.0, 0.7}) EXPECT_NEAR(glsl::phase_draine(0, 1, c), 3 / (16 * kPi) * (1 + c * c), 1e-8);
}

// Mie's series for spheres of the refractive index 1.33 at 0.55 um, in the mean over diameters within 10%, has
// these mean cosines; the fit is within 0.02 of them.
TEST(Phase, DropletsAreNormalisedAndScatterForwardAsMiesDo) {
    struct Case {
        float diameter;
        double mie;
    };
    for (const auto& [diameter, mie] :
         {Case{5, 0.828}, Case{8, 0.848}, Case{10, 0.852}, Case{20, 0.867}, Case{50, 0.877}}) {
        const auto lobes = glsl::phase_of_droplets(diameter);
        const auto p = [&](double c) {
            return double{
                glsl::phase(glsl::PHASE_HG_DRAINE, lobes.x, lobes.y, lobes.z, lobes.w, static_cast<float>(c))};
        };
        EXPECT_NEAR(sphere_integral(p, 1), 1, 1e-3) << diameter;
        EXPECT_NEAR(sphere_integral([&](double c) { return c * p(c); }, 1), mie, 0.02) << diameter;
    }
}

TEST(Phase, ForwardScatteringIsTheLargerForPositiveG) {
    for (int kind : {glsl::PHASE_HENYEY_GREENSTEIN, glsl::PHASE_SCHLICK}) {
        EXPECT_GT(eval(kind, 0.4f, 1.0), eval(kind, 0.4f, 0.0));
        EXPECT_GT(eval(kind, 0.4f, 0.0), eval(kind, 0.4f, -1.0));
        for (float g : kAnisotropies) {
            for (double c : {-1.0, -0.7, 0.0, 0.2, 1.0}) {
                EXPECT_EQ(eval(kind, g, c), eval(kind, -g, -c));
            }
        }
    }
}

TEST(Phase, NoAnisotropyIsIsotropic) {
    for (int kind : {glsl::PHASE_ISOTROPIC, glsl::PHASE_HENYEY_GREENSTEIN, glsl::PHASE_SCHLICK}) {
        for (double c : {-1.0, -0.3, 0.0, 1.0}) {
            EXPECT_NEAR(eval(kind, 0.0f, c), 1.0 / (4.0 * kPi), 1e-8);
        }
    }
}

// Total variation, half the integral of the absolute difference: the share of the light that goes elsewhere.
TEST(Phase, SchlickIsCloseToHenyeyGreenstein) {
    struct Case {
        float g;
        double bound;
    };
    for (const Case& k :
         {Case{0.1f, 0.005}, Case{0.3f, 0.03}, Case{0.5f, 0.06}, Case{0.7f, 0.09}, Case{0.9f, 0.25}}) {
        const double difference =
            0.5 * sphere_integral(
                      [&](double c) { return std::abs(eval(glsl::PHASE_SCHLICK, k.g, c) - hg_exact(k.g, c)); }, 1);
        EXPECT_LT(difference, k.bound) << k.g;
    }
}

TEST(Phase, StaysFiniteAndPositiveForEveryInput) {
    for (int kind : {glsl::PHASE_HENYEY_GREENSTEIN, glsl::PHASE_SCHLICK, glsl::PHASE_CORNETTE_SHANKS,
                     glsl::PHASE_DOUBLE_HENYEY_GREENSTEIN, glsl::PHASE_HG_DRAINE}) {
        for (float g : {-1.0f, -0.999f, -0.97f, 0.0f, 0.94f, 0.97f, 0.999f, 1.0f}) {
            for (float c : {-1.0000002f, -1.0f, 0.0f, 1.0f, 1.0000002f}) {
                const float p = glsl::phase(kind, g, -0.999f, 30.0f, 0.5f, c);
                EXPECT_TRUE(std::isfinite(p) && p > 0.0f)
                    << "kind " << kind << " g " << g << " c " << c << ": " << p;
            }
        }
    }
}

}  // namespace
