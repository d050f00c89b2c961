// A spot's cone over a segment near the lamp, where the kinks of its law lie between the nodes of the rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shaders/lib/glm_subset.h"
#include "tests/unit/shader_lib/quadrature.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/lamp_segment.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

struct Cone {
    double inner, outer;  // half angles
    [[nodiscard]] double law(double cosine) const {
        const double c =
            (cosine - std::cos(outer)) / std::max(0.001 * (1 - std::cos(outer)), std::cos(inner) - std::cos(outer));
        const double clamped = std::clamp(c, 0.0, 1.0);
        return clamped * clamped;
    }
};

// Segments in the outer cone, h from the lamp. The relative error of the rule, as it is and corrected.
struct Errors {
    double plain = 0, corrected = 0;
};

// range: of the lamp, 0 for none.
Errors errors_over(std::mt19937& random, double h, double least_flank, double range = 0) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const Cone cone{.inner = 0.1 + 0.5 * uniform(random), .outer = 0};
    Cone c = cone;
    c.outer = c.inner + least_flank + 0.4 * uniform(random);
    // The axis leans from the perpendicular to the ray by up to 60 degrees, in any direction.
    const double lean = uniform(random), turn = 6.283 * uniform(random);
    const double along = std::cos(lean), across = std::sin(lean) * std::cos(turn);
    const auto cosine = [&](double u) { return (along * h + across * u) / std::hypot(h, u); };
    // Walk the angle to find where the cone begins and ends.
    double begin = 2, end = -2;
    for (int i = 0; i <= 4000; ++i) {
        const double phi = -1.5 + 3.0 * i / 4000;
        if (c.law(cosine(h * std::tan(phi))) <= 0) continue;
        begin = std::min(begin, phi);
        end = std::max(end, phi);
    }
    const double reach = range > 0 ? std::acos(std::min(1.0, h / range)) : 2;
    begin = std::max(begin, -reach);
    end = std::min(end, reach);
    if (end - begin < 0.05) return {};
    const double a = h * std::tan(begin), b = h * std::tan(end);
    double exact = 0;  // int cone / (h^2 + u^2) du, kinks lie where the midpoint rule does not mind
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double phi = begin + (end - begin) * (i + 0.5) / n;
        const double s = range > 0 ? std::pow(h / std::cos(phi) / range, 4) : 0;
        exact += c.law(cosine(h * std::tan(phi))) * (1 - s) * (end - begin) / n / h;
    }
    if (exact * h < 0.1 * (end - begin)) return {};  // next to nothing, at the end of the range
    glsl::LampRay ray;
    ray.t_closest = 5;
    ray.h = static_cast<float>(h);
    const float t0 = static_cast<float>(5 + a), t1 = static_cast<float>(5 + b);
    const glsl::LampSegment rule =
        glsl::lamp_segment(ray, t0, t1, 0.01f, range > 0 ? static_cast<float>(1 / range) : 0.0f);
    const glm::vec2 law =
        glsl::spot_scale_offset(static_cast<float>(std::cos(c.inner)), static_cast<float>(std::cos(c.outer)));
    double plain = 0;
    for (int i = 0; i < 4; ++i) plain += rule.weight[i] * c.law(cosine(rule.t[i] - 5.0));
    const double corrected =
        plain * glsl::lamp_segment_cone_correction(rule, ray, t0, t1, 0.01f, static_cast<float>(along),
                                                   static_cast<float>(across), law);
    return {std::abs(plain / exact - 1), std::abs(corrected / exact - 1)};
}

TEST(SpotCone, CorrectionMakesTheConeExactNearTheLamp) {
    std::mt19937 random(5);
    Errors worst;
    double plain = 0;
    constexpr int count = 400;
    for (int i = 0; i < count; ++i) {
        const Errors e = errors_over(random, 0.05 * std::pow(100.0, i / double(count)), 0.05);
        worst.corrected = std::max(worst.corrected, e.corrected);
        worst.plain = std::max(worst.plain, e.plain);
        plain += e.plain / count;
    }
    EXPECT_LT(worst.corrected, 0.003);
    EXPECT_GT(worst.plain, 0.03);  // what it is for
    EXPECT_GT(plain, 0.003);
}

TEST(SpotCone, TheRangeOfTheLampIsNotCountedTwice) {
    std::mt19937 random(7);
    Errors sum;
    constexpr int count = 200;
    for (int i = 0; i < count; ++i) {
        const Errors e = errors_over(random, 2, 0.05, 2.2 + 0.02 * i);
        EXPECT_LT(e.corrected, 0.06) << i;
        sum.corrected += e.corrected / count;
        sum.plain += e.plain / count;
    }
    EXPECT_LT(sum.corrected, 0.01);
}

TEST(SpotCone, AThinFlankIsAStep) {
    std::mt19937 random(6);
    for (int i = 0; i < 100; ++i) EXPECT_LT(errors_over(random, 0.3, 1e-3).corrected, 0.005) << i;
}

TEST(SpotCone, OnThePlateauThereIsNothingToCorrect) {
    glsl::LampRay ray;
    ray.t_closest = 0;
    ray.h = 1;
    const glsl::LampSegment rule = glsl::lamp_segment(ray, -0.1f, 0.1f, 0.01f, 0.0f);
    const glm::vec2 law = glsl::spot_scale_offset(std::cos(0.5f), std::cos(0.7f));
    EXPECT_NEAR(glsl::lamp_segment_cone_correction(rule, ray, -0.1f, 0.1f, 0.01f, 1, 0, law), 1, 1e-5);
}

}  // namespace
