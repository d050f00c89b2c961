#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "shaders/lib/glm_subset.h"
#include "tests/unit/shader_lib/quadrature.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/lamp_segment.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

// The law in double precision, with the clamp and the window written as in KHR_lights_punctual.
struct Lamp {
    double t_closest;
    double h;
    double radius;
    double range;  // 0: none

    double attenuation(double t) const {
        const double d2 = h * h + (t - t_closest) * (t - t_closest);
        const double ratio = range > 0.0 ? d2 / (range * range) : 0.0;
        return std::clamp(1.0 - ratio * ratio, 0.0, 1.0) / std::max(d2, radius * radius);
    }

    // int_a^b attenuation(t) f(t) dt, cut where the law has a kink and substituted by t = t_closest + s tan(v),
    // which flattens the peak.
    template <typename F>
    double integral(double a, double b, const F& f) const {
        std::vector<double> cuts{a, b};
        for (double edge : {radius, range}) {
            if (edge > h) {
                cuts.push_back(t_closest - std::sqrt(edge * edge - h * h));
                cuts.push_back(t_closest + std::sqrt(edge * edge - h * h));
            }
        }
        const double s = std::max(h, radius);
        std::sort(cuts.begin(), cuts.end());
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const double lo = std::clamp(cuts[i], a, b);
            const double hi = std::clamp(cuts[i + 1], a, b);
            if (lo < hi) {
                sum += test::integrate(
                    [&](double v) {
                        const double t = t_closest + s * std::tan(v);
                        return attenuation(t) * f(t) * s / (std::cos(v) * std::cos(v));
                    },
                    std::atan((lo - t_closest) / s), std::atan((hi - t_closest) / s));
            }
        }
        return sum;
    }

    double integral(double a, double b) const {
        return integral(a, b, [](double) { return 1.0; });
    }

    glsl::LampSegment segment(double a, double b) const {
        glsl::LampRay ray;
        ray.t_closest = static_cast<float>(t_closest);
        ray.h = static_cast<float>(h);
        return glsl::lamp_segment(ray, static_cast<float>(a), static_cast<float>(b), static_cast<float>(radius),
                                  range > 0.0 ? static_cast<float>(1.0 / range) : 0.0f);
    }
};

// Volatile: GCC 12 at -O3 drops the pair of conversions where it vectorises.
double rounded(double x) {
    const volatile float single = static_cast<float>(x);
    return single;
}

struct Case {
    Lamp lamp;
    double a;
    double b;
};

// Segments of 1 mm to 100 m, before, around and behind lamps at 0 to 20 m from the ray.
Case random_case(std::mt19937& random, bool with_range) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Case c{};
    c.lamp.h = unit(random) < 0.1 ? 0.0 : rounded(0.002 * std::pow(1e4, unit(random)));
    c.lamp.radius = rounded(unit(random) < 0.5 ? 0.01 : 0.01 * std::pow(50.0, unit(random)));
    c.lamp.range = with_range ? rounded(12.0 * c.lamp.radius + 20.0 * unit(random)) : 0.0;
    c.lamp.t_closest = rounded(-20.0 + 60.0 * unit(random));
    const double length = 0.001 * std::pow(1e5, unit(random));
    const double spread = unit(random) < 0.5 ? 2.0 * length : 20.0;
    c.a = rounded(c.lamp.t_closest + spread * (unit(random) - 0.5) - 0.5 * length);
    c.b = rounded(c.a + length);
    return c;
}

std::string describe(const Case& c) {
    std::ostringstream text;
    text << std::setprecision(12) << "h " << c.lamp.h << " radius " << c.lamp.radius << " range " << c.lamp.range
         << " segment from " << c.a - c.lamp.t_closest << " to " << c.b - c.lamp.t_closest << " about t_closest "
         << c.lamp.t_closest;
    return text.str();
}

TEST(LampAttenuation, IsInverseSquareClampedAtTheRadius) {
    EXPECT_NEAR(glsl::lamp_attenuation(9.0f, 0.01f, 0.0f), 1.0f / 9.0f, 1e-8f);
    EXPECT_NEAR(glsl::lamp_attenuation(1e-6f, 0.5f, 0.0f), 4.0f, 1e-5f);
    EXPECT_TRUE(std::isfinite(glsl::lamp_attenuation(0.0f, 0.0f, 0.0f)));
}

TEST(LampAttenuation, RangeWindow) {
    EXPECT_NEAR(glsl::lamp_attenuation(25.0f, 0.01f, 0.1f), (1.0f - 0.0625f) / 25.0f, 1e-7f);
    EXPECT_EQ(glsl::lamp_attenuation(100.0f, 0.01f, 0.1f), 0.0f);
    EXPECT_EQ(glsl::lamp_attenuation(1e4f, 0.01f, 0.1f), 0.0f);
}

TEST(SpotCone, FollowsTheRecommendedLaw) {
    const double inner = 0.3;
    const double outer = 0.7;
    const glm::vec2 so =
        glsl::spot_scale_offset(static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer)));
    EXPECT_NEAR(glsl::spot_cone(static_cast<float>(std::cos(0.29)), so), 1.0f, 1e-6f);
    EXPECT_EQ(glsl::spot_cone(static_cast<float>(std::cos(0.71)), so), 0.0f);
    const double s = (std::cos(0.5) - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
    EXPECT_NEAR(glsl::spot_cone(static_cast<float>(std::cos(0.5)), so), s * s, 1e-6);
    const glm::vec2 sharp = glsl::spot_scale_offset(0.5f, 0.5f);
    EXPECT_TRUE(std::isfinite(sharp.x) && std::isfinite(sharp.y));
}

TEST(LampRay, NearestPointAndDistance) {
    const glsl::LampRay ray = glsl::lamp_ray(glm::vec3(1, 2, 3), glm::vec3(0, 0, 1), glm::vec3(4, 6, -7));
    EXPECT_FLOAT_EQ(ray.t_closest, -10.0f);
    EXPECT_FLOAT_EQ(ray.h, 5.0f);
}

TEST(LampSegment, IntegralMatchesQuadrature) {
    for (bool with_range : {false, true}) {
        std::mt19937 random(3);
        for (int i = 0; i < 20000; ++i) {
            const Case c = random_case(random, with_range);
            const double expected = c.lamp.integral(c.a, c.b);
            Lamp unlimited = c.lamp;
            unlimited.range = 0.0;
            // The rounding of the window is absolute: 1e-6 of the light without it.
            const double sphere = with_range ? std::pow(c.lamp.radius / c.lamp.range, 4) / 4.0 : 0.0;
            const double tolerance =
                (6e-6 + sphere) * expected + 1e-6 * (with_range ? unlimited.integral(c.a, c.b) : 0.0);
            ASSERT_NEAR(glsl::lamp_segment_integral(c.lamp.segment(c.a, c.b)), expected, tolerance) << describe(c);
        }
    }
}

TEST(LampSegment, LampOnTheRayHasAFiniteIntegral) {
    const Lamp lamp{0.0, 0.0, 0.01, 0.0};
    // Outside the sphere 1/a - 1/b on each side, inside it the chord over the radius squared.
    EXPECT_NEAR(glsl::lamp_segment_integral(lamp.segment(-1.0, 1.0)), 2.0 * (100.0 - 1.0) + 0.02 / 1e-4, 1e-3);
    EXPECT_NEAR(glsl::lamp_segment_integral(lamp.segment(2.0, 5.0)), 0.3, 1e-6);
    EXPECT_NEAR(glsl::lamp_segment_integral(lamp.segment(-0.002, 0.001)), 30.0, 1e-4);
    const Lamp point{0.0, 0.0, 0.0, 0.0};
    EXPECT_TRUE(std::isfinite(glsl::lamp_segment_integral(point.segment(-1.0, 1.0))));
}

TEST(LampSegment, OutOfRangeAddsNothing) {
    const Lamp beside{0.0, 6.0, 0.01, 5.0};
    EXPECT_EQ(glsl::lamp_segment_integral(beside.segment(-10.0, 10.0)), 0.0f);
    const Lamp ahead{20.0, 1.0, 0.01, 5.0};
    EXPECT_EQ(glsl::lamp_segment_integral(ahead.segment(0.0, 10.0)), 0.0f);
    EXPECT_EQ(glsl::lamp_segment_integral(ahead.segment(3.0, 3.0)), 0.0f);
}

TEST(LampSegment, IsAdditive) {
    std::mt19937 random(5);
    for (int i = 0; i < 5000; ++i) {
        const Case c = random_case(random, i % 2 == 0);
        const double split = rounded(c.a + (c.b - c.a) * 0.37);
        const double parts = double{glsl::lamp_segment_integral(c.lamp.segment(c.a, split))} +
                             double{glsl::lamp_segment_integral(c.lamp.segment(split, c.b))};
        Lamp unlimited = c.lamp;
        unlimited.range = 0.0;
        ASSERT_NEAR(glsl::lamp_segment_integral(c.lamp.segment(c.a, c.b)), parts,
                    6e-6 * parts + 2e-6 * unlimited.integral(c.a, c.b))
            << describe(c);
    }
}

TEST(LampSegment, NodesLieInsideAndWeightsAreNotNegative) {
    std::mt19937 random(13);
    for (int i = 0; i < 50000; ++i) {
        const Case c = random_case(random, i % 2 == 0);
        const glsl::LampSegment s = c.lamp.segment(c.a, c.b);
        for (int k = 0; k < 4; ++k) {
            ASSERT_TRUE(s.weight[k] >= 0.0f && std::isfinite(s.weight[k])) << describe(c);
            ASSERT_TRUE(c.a <= s.t[k] && s.t[k] <= c.b) << describe(c);
            ASSERT_TRUE(k == 0 || s.t[k - 1] <= s.t[k]) << describe(c);
        }
    }
}

struct Error {
    double squares = 0.0;
    double worst = 0.0;
    int count = 0;
    void add(double relative) {
        squares += relative * relative;
        worst = std::max(worst, std::abs(relative));
        ++count;
    }
    double rms() const { return std::sqrt(squares / count); }
};

// The segments on which the ways to fold in the transmittance were compared.
Case fog_case(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Case c{};
    c.lamp.h = rounded(0.02 * std::pow(1000.0, unit(random)));
    c.lamp.radius = 0.01f;
    const double length = 0.05 * std::pow(1000.0, unit(random));
    c.a = 0.0;
    c.b = rounded(length);
    c.lamp.t_closest =
        rounded((1.2 - 1.4 * unit(random)) * std::max(length, unit(random) < 0.5 ? 4.0 * c.lamp.h : 0.0));
    return c;
}

struct Ratio {
    Error rule;
    Error mean;
};

// Errors of the rule, and of one sample at its mean, for the integral of attenuation, Henyey-Greenstein phase and
// transmittance over segments of an optical depth up to max_depth.
Ratio measure(double g, double max_depth) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Ratio ratio;
    for (int i = 0; i < 10000; ++i) {
        const Case c = fog_case(random);
        const double sigma_t = max_depth * unit(random) / c.b;
        const auto phase = [&](double t) {
            const double u = t - c.lamp.t_closest;
            return (1 - g * g) / std::pow(1 + g * g + 2 * g * u / std::hypot(u, c.lamp.h), 1.5);
        };
        const double expected =
            c.lamp.integral(c.a, c.b, [&](double t) { return phase(t) * std::exp(-sigma_t * t); });
        const glsl::LampSegment s = c.lamp.segment(c.a, c.b);
        double sum = 0.0, mean = 0.0;
        for (int k = 0; k < 4; ++k) {
            sum += s.weight[k] * phase(s.t[k]) * std::exp(-sigma_t * s.t[k]);
            mean += s.weight[k] * s.t[k] / glsl::lamp_segment_integral(s);
        }
        ratio.rule.add(sum / expected - 1.0);
        ratio.mean.add(glsl::lamp_segment_integral(s) * phase(mean) * std::exp(-sigma_t * mean) / expected - 1.0);
    }
    return ratio;
}

TEST(LampSegment, TransmittanceInsideTheSegment) {
    const Ratio thin = measure(0.0, 0.3);
    EXPECT_LT(thin.rule.rms(), 5e-4);
    EXPECT_LT(thin.rule.worst, 4e-3);
    EXPECT_LT(thin.mean.rms(), 2e-3);
    const Ratio middle = measure(0.0, 1.0);
    EXPECT_LT(middle.rule.rms(), 2e-3);
    EXPECT_LT(middle.rule.worst, 0.02);
    EXPECT_LT(middle.mean.rms(), 0.02);
    const Ratio thick = measure(0.0, 3.0);
    EXPECT_LT(thick.rule.rms(), 0.013);
    EXPECT_LT(thick.rule.worst, 0.13);
    EXPECT_LT(thick.mean.rms(), 0.13);
}

TEST(LampSegment, PhaseAlongTheSegment) {
    const Ratio mild = measure(0.3, 0.5);
    EXPECT_LT(mild.rule.rms(), 2.5e-3);
    EXPECT_LT(mild.rule.worst, 0.015);
    const Ratio medium = measure(0.6, 0.5);
    EXPECT_LT(medium.rule.rms(), 0.018);
    EXPECT_LT(medium.rule.worst, 0.06);
    const Ratio peaked = measure(0.85, 0.5);
    EXPECT_LT(peaked.rule.rms(), 0.15);
    for (const Ratio& ratio : {mild, medium, peaked}) {
        EXPECT_LT(ratio.rule.rms(), 0.3 * ratio.mean.rms());
    }
}

// Places at even shares of the light: as many lie before any point of the segment as light does. The places that
// know the inverse square alone are for comparison.
TEST(LampSegment, PlacesLieAsDenselyAsThereIsLight) {
    std::mt19937 random(29);
    Error placed, equi_angular;
    for (int i = 0; i < 200; ++i) {
        const Case c = fog_case(random);
        const double sigma_t = 3 / c.b;
        const auto phase = [&](double t) {
            const double u = t - c.lamp.t_closest;
            return 0.64 / std::pow(1.36 + 1.2 * u / std::hypot(u, c.lamp.h), 1.5);
        };
        const auto light = [&](double t) { return phase(t) * std::exp(-sigma_t * t); };
        const glsl::LampSegment s = c.lamp.segment(c.a, c.b);
        glsl::vec4 parts;
        for (int k = 0; k < 4; ++k) parts[k] = s.weight[k] * static_cast<float>(light(s.t[k]));
        for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            // By halving: where that share of the inverse square lies, and what share of the light does before it.
            const auto light_before = [&](double inverse_square_share) {
                double low = c.a, high = c.b;
                for (int k = 0; k < 40; ++k) {
                    const double t = 0.5 * (low + high);
                    (c.lamp.integral(c.a, t) < inverse_square_share * c.lamp.integral(c.a, c.b) ? low : high) = t;
                }
                return c.lamp.integral(c.a, low, light) / c.lamp.integral(c.a, c.b, light);
            };
            placed.add(light_before(glsl::lamp_segment_place(parts, static_cast<float>(share))) - share);
            equi_angular.add(light_before(share) - share);
        }
    }
    EXPECT_LT(placed.rms(), 0.09);
    EXPECT_LT(placed.rms(), 0.25 * equi_angular.rms());
}

// The share of the light before a share of the inverse square, which outside the lamp's sphere is that of the
// angle.
TEST(LampSegment, SharesAreThoseOfTheLightGathered) {
    const auto error = [](double g, double depth) {
        std::mt19937 random(31);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        Error of_share;
        for (int i = 0; i < 1000; ++i) {
            const Case c = fog_case(random);
            const auto light = [&](double t) {
                const double u = t - c.lamp.t_closest, d = std::hypot(u, c.lamp.h);
                return (1 - g * g) / std::pow(1 + g * g + 2 * g * u / d, 1.5) * std::exp(-depth / c.b * t);
            };
            const glsl::LampSegment s = c.lamp.segment(c.a, c.b);
            glsl::vec4 parts;
            for (int k = 0; k < 4; ++k) parts[k] = s.weight[k] * static_cast<float>(light(s.t[k]));
            const double t = c.a + unit(random) * (c.b - c.a);
            const double angles = c.lamp.integral(c.a, t) / c.lamp.integral(c.a, c.b);
            const double share = glsl::lamp_segment_share(parts, static_cast<float>(angles));
            of_share.add(share - c.lamp.integral(c.a, t, light) / c.lamp.integral(c.a, c.b, light));
        }
        return of_share;
    };
    EXPECT_LT(error(0.0, 0.05).rms(), 5e-4);
    EXPECT_LT(error(0.3, 1.0).rms(), 5e-3);
    EXPECT_LT(error(0.6, 1.0).rms(), 0.015);
    for (const glsl::vec4 parts : {glsl::vec4(1, 2, 3, 4), glsl::vec4(0, 1, 0, 0), glsl::vec4(0)}) {
        EXPECT_EQ(glsl::lamp_segment_share(parts, 0), 0);
        EXPECT_NEAR(glsl::lamp_segment_share(parts, 1), 1, 1e-6);
    }
}

TEST(LampSegment, PlacesRiseFromEndToEnd) {
    for (const glsl::vec4 parts : {glsl::vec4(1, 2, 3, 4), glsl::vec4(0, 1, 0, 0), glsl::vec4(0, 0, 0, 5),
                                   glsl::vec4(1e-20F, 0, 0, 1), glsl::vec4(0)}) {
        float before = 0;
        for (int i = 0; i <= 100; ++i) {
            const float place = glsl::lamp_segment_place(parts, static_cast<float>(i) / 100);
            EXPECT_GE(place, before);
            EXPECT_LE(place, 1.0F);
            before = place;
        }
    }
    EXPECT_EQ(glsl::lamp_segment_place(glsl::vec4(0), 0.3F), 0.3F);
    EXPECT_GT(glsl::lamp_segment_place(glsl::vec4(0, 0, 0, 5), 0.01F), 1 - 0.17392742F);
}

// Forward scattering: the lamp lies ahead, its light travels towards the eye.
TEST(LampSegment, CosThetaIsForwardBeforeTheLamp) {
    glsl::LampRay ray;
    ray.t_closest = 10.0f;
    ray.h = 3.0f;
    const glsl::LampSegment before = glsl::lamp_segment(ray, 5.999f, 6.001f, 0.01f, 0.0f);
    EXPECT_NEAR(glsl::lamp_segment_cos_theta(before, ray).x, 0.8f, 1e-3f);
    const glsl::LampSegment behind = glsl::lamp_segment(ray, 13.999f, 14.001f, 0.01f, 0.0f);
    EXPECT_NEAR(glsl::lamp_segment_cos_theta(behind, ray).w, -0.8f, 1e-3f);
    ray.h = 0.0f;
    EXPECT_TRUE(
        std::isfinite(glsl::lamp_segment_cos_theta(glsl::lamp_segment(ray, 9.0f, 11.0f, 0.01f, 0.0f), ray).y));
}

}  // namespace
