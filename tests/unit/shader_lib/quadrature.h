#pragma once
// Numerical integration in double precision for the expectations of the tests in this folder.

#include <array>
#include <cmath>

namespace tyndall::test {

// Eight-point Gauss-Legendre over [a, b].
template <typename F>
double gauss_legendre(const F& f, double a, double b) {
    constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
    constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};
    const double middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a);
    double sum = 0.0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
    }
    return sum * half;
}

// The same over equal panels; for integrands in single precision, whose noise an adaptive rule would chase.
template <typename F>
double integrate_panels(const F& f, double a, double b, int panels) {
    double sum = 0.0;
    for (int i = 0; i < panels; ++i) {
        sum += gauss_legendre(f, a + (b - a) * i / panels, a + (b - a) * (i + 1) / panels);
    }
    return sum;
}

// Adaptive: halves until one rule and its two halves agree to the tolerance, relative to the whole.
template <typename F>
double integrate(const F& f, double a, double b, double tolerance = 1e-11) {
    const auto refine = [&f](const auto& self, double lo, double hi, double whole, double limit,
                             int depth) -> double {
        const double middle = 0.5 * (lo + hi);
        const double left = gauss_legendre(f, lo, middle);
        const double right = gauss_legendre(f, middle, hi);
        if (depth == 0 || std::abs(left + right - whole) <= limit) {
            return left + right;
        }
        return self(self, lo, middle, left, 0.5 * limit, depth - 1) +
               self(self, middle, hi, right, 0.5 * limit, depth - 1);
    };
    const double estimate = integrate_panels([&f](double t) { return std::abs(f(t)); }, a, b, 16);
    return refine(refine, a, b, gauss_legendre(f, a, b), tolerance * estimate, 20);
}

}  // namespace tyndall::test
