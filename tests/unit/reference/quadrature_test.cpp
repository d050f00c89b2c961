#include "reference/quadrature.h"

#include <gtest/gtest.h>

#include <numbers>

namespace tyndall::reference {
namespace {

using glm::dvec3;

TEST(ReferenceQuadrature, RuleIsExactUpToDegree22) {
    for (int degree = 0; degree <= 22; ++degree) {
        const auto power = [&](double x) { return std::pow(x, degree); };
        EXPECT_NEAR(gauss_kronrod<double>(power, 0, 1).value, 1.0 / (degree + 1), 2e-16) << degree;
    }
    // From degree 23 on an error shows: degree 24 over [-1, 1].
    const double twentyfour = gauss_kronrod<double>([](double x) { return std::pow(x, 24); }, -1, 1).value;
    EXPECT_GT(std::abs(twentyfour - 2.0 / 25), 1e-10);
}

TEST(ReferenceQuadrature, KnownIntegrals) {
    struct Case {
        double (*f)(double);
        double a, b, value;
    };
    const double pi = std::numbers::pi;
    for (const Case& c : {Case{[](double x) { return std::exp(-x); }, 0, 30, -std::expm1(-30)},
                          Case{[](double x) { return 1 / (1e-4 + x * x); }, -1, 1, 200 * std::atan(100.0)},
                          Case{[](double x) { return std::abs(x - 0.3); }, 0, 1, 0.29},
                          Case{[](double x) { return std::sqrt(x); }, 0, 1, 2.0 / 3},
                          Case{[](double x) { return std::sin(50 * x) * std::sin(50 * x); }, 0, pi, pi / 2}}) {
        const double points[] = {c.a, c.b};
        const Integral<double> found = integrate<double>(c.f, points, {0, 1e-9});
        EXPECT_NEAR(found.value, c.value, 1e-9 * c.value);
        EXPECT_GE(found.error + 1e-14 * c.value, std::abs(found.value - c.value));
    }
}

TEST(ReferenceQuadrature, ChannelsShareNodesAndTheWorstDecides) {
    const double points[] = {0, 1};
    const auto f = [](double x) { return dvec3(1, std::abs(x - 1 / 3.0), std::exp(20 * (x - 1))); };
    const Integral<dvec3> found = integrate<dvec3>(f, points, {1e-10, 0});
    EXPECT_NEAR(found.value.x, 1, 1e-14);
    EXPECT_NEAR(found.value.y, 5.0 / 18, 1e-10);
    EXPECT_NEAR(found.value.z, -std::expm1(-20) / 20, 1e-10);
}

TEST(ReferenceQuadrature, OneBudgetForManySources) {
    // A large smooth integrand and a small wild one: the latter may stay as it is when the sum is exact enough.
    int wild_calls = 0;
    const auto f = [&](int source, double x) {
        if (source == 0) return 1e6 * std::exp(x);
        ++wild_calls;
        return std::sin(400 * x) + 1;
    };
    std::vector<Panel<double>> panels;
    for (const int source : {0, 1})
        panels.push_back({0, 1, source, gauss_kronrod<double>([&](double x) { return f(source, x); }, 0, 1)});
    const Integral<double> found = refine<double>(f, panels, {0, 1e-3});
    EXPECT_EQ(wild_calls, 15);
    EXPECT_NEAR(found.value, 1e6 * std::expm1(1), 1e3);
}

TEST(ReferenceQuadrature, GivesUpAndSaysSo) {
    const double points[] = {0, 1};
    const auto singular = [](double x) { return std::sin(1 / x) / x; };
    const Integral<double> found = integrate<double>(singular, points, {0, 1e-12, 50});
    EXPECT_GT(found.error, 1e-6);
    const Integral<double> step =
        integrate<double>([](double x) { return x < 0.7 ? 0.0 : 1.0; }, points, {0, 1e-13});
    EXPECT_NEAR(step.value, 0.3, 1e-12);
}

}  // namespace
}  // namespace tyndall::reference
