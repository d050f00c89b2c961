#include "reference/density_line.h"

#include <algorithm>
#include <iterator>

namespace tyndall::reference {

// The cubic through f(0), f(1/3), f(2/3), f(1) is
//     f0 + (-11 f0 + 18 f1 - 9 f2 + 2 f3) u / 2 + 9 (2 f0 - 5 f1 + 4 f2 - f3) u² / 2
//        + 9 (-f0 + 3 f1 - 3 f2 + f3) u³ / 2.
void DensityLine::add(double begin, double end, const std::array<double, 4>& density) {
    const auto [f0, f1, f2, f3] = density;
    const double length = end - begin;
    const double before = stretches_.empty() ? 0 : stretches_.back().integral_to(stretches_.back().end);
    stretches_.push_back(
        {begin,
         end,
         before,
         {length * f0, length * (-11 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 4,
          length * 1.5 * (2 * f0 - 5 * f1 + 4 * f2 - f3), length * 1.125 * (-f0 + 3 * f1 - 3 * f2 + f3)}});
}

double DensityLine::Stretch::integral_to(double t) const {
    const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
    const auto& a = antiderivative;
    return before + u * (a[0] + u * (a[1] + u * (a[2] + u * a[3])));
}

double DensityLine::integral_to(double t) const {
    if (stretches_.empty() || t <= stretches_.front().begin) return 0;
    const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), t,
                                        [](double value, const Stretch& s) { return value < s.begin; });
    return std::prev(after)->integral_to(t);
}

std::vector<double> DensityLine::knots() const {
    std::vector<double> knots;
    for (const Stretch& s : stretches_) {
        if (knots.empty() || knots.back() != s.begin) knots.push_back(s.begin);
        knots.push_back(s.end);
    }
    return knots;
}

}  // namespace tyndall::reference
