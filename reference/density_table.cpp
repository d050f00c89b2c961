#include "reference/density_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::reference {

// f(x) = sum c_k T_k(x) through the points cos(i pi / n). Its antiderivative has b_k = (c_(k-1) - c_(k+1)) / (2 k),
// with c_0 doubled, and b_0 such that it is 0 at -1, where T_k = (-1)^k.
DensityTable::Panel DensityTable::fit(const std::function<double(double)>& density, double begin, double end) {
    constexpr int n = degree;
    static const auto cosines = [] {
        std::array<double, 2 * n> table{};
        for (int i = 0; i < 2 * n; ++i) table[static_cast<std::size_t>(i)] = std::cos(i * std::numbers::pi / n);
        return table;
    }();
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    std::array<double, n + 1> f{};
    for (std::size_t i = 0; i <= n; ++i) f[i] = density(middle + half * cosines[i]);
    std::array<double, n + 3> c{};
    for (std::size_t k = 0; k <= n; ++k) {
        double sum = 0.5 * (f[0] + (k % 2 == 0 ? f[n] : -f[n]));
        for (std::size_t i = 1; i < n; ++i) sum += f[i] * cosines[i * k % (2 * n)];
        c[k] = sum * (k == 0 || k == n ? 1.0 : 2.0) / n;
    }
    Panel panel{begin, end};
    panel.error = half * (std::abs(c[n]) + std::abs(c[n - 1]));
    auto& b = panel.antiderivative;
    for (std::size_t k = 1; k <= n + 1; ++k) {
        b[k] = half * ((k == 1 ? 2 * c[0] : c[k - 1]) - c[k + 1]) / (2 * static_cast<double>(k));
        b[0] += k % 2 == 1 ? b[k] : -b[k];
    }
    return panel;
}

// Clenshaw's sum.
double DensityTable::Panel::integral_to(double t) const {
    const double x = std::clamp((2 * t - begin - end) / (end - begin), -1.0, 1.0);
    double b1 = 0, b2 = 0;
    for (std::size_t k = degree + 1; k >= 1; --k) {
        const double b0 = antiderivative[k] + 2 * x * b1 - b2;
        b2 = b1;
        b1 = b0;
    }
    return antiderivative[0] + x * b1 - b2;
}

DensityTable::DensityTable(const std::function<double(double)>& density, std::span<const double> knots,
                           double tolerance) {
    constexpr std::size_t most = 20000;
    const auto less = [](const Panel& l, const Panel& r) { return l.error < r.error; };
    double error = 0;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        if (!(knots[i] < knots[i + 1])) continue;
        panels_.push_back(fit(density, knots[i], knots[i + 1]));
        error += panels_.back().error;
    }
    std::make_heap(panels_.begin(), panels_.end(), less);
    while (error > tolerance && panels_.size() < most) {
        std::pop_heap(panels_.begin(), panels_.end(), less);
        const Panel whole = panels_.back();
        const double middle = 0.5 * (whole.begin + whole.end);
        if (!(whole.begin < middle && middle < whole.end)) break;
        panels_.pop_back();
        error -= whole.error;
        for (const Panel& part : {fit(density, whole.begin, middle), fit(density, middle, whole.end)}) {
            error += part.error;
            panels_.push_back(part);
            std::push_heap(panels_.begin(), panels_.end(), less);
        }
    }
    std::sort(panels_.begin(), panels_.end(), [](const Panel& l, const Panel& r) { return l.begin < r.begin; });
    double sum = 0;
    for (Panel& panel : panels_) {
        panel.before = sum;
        sum += panel.integral_to(panel.end);
    }
}

double DensityTable::integral_to(double t) const {
    if (panels_.empty() || t <= panels_.front().begin) return 0;
    const auto after = std::upper_bound(panels_.begin(), panels_.end(), t,
                                        [](double value, const Panel& panel) { return value < panel.begin; });
    const Panel& panel = *std::prev(after);
    return panel.before + panel.integral_to(t);
}

}  // namespace tyndall::reference
