#include "bench/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"

namespace tyndall::bench {
namespace {

double quantile(std::span<const double> sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

bool positive(glm::dvec2 p) {
    return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// f(x) with ln f linear in ln x through a and b.
double between(glm::dvec2 a, glm::dvec2 b, double x) {
    return a.y * std::pow(b.y / a.y, std::log(x / a.x) / std::log(b.x / a.x));
}

}  // namespace

MedianSpread median_spread(std::span<const double> values) {
    TYNDALL_CHECK(!values.empty());
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return {quantile(sorted, 0.5), quantile(sorted, 0.75) - quantile(sorted, 0.25), sorted.front()};
}

std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].x) && std::isfinite(points[i].y)) order.push_back(i);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || points[i].y < points[front.back()].y) front.push_back(i);
    return front;
}

PowerFit fit_power(std::span<const glm::dvec2> points) {
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    double first = std::numeric_limits<double>::infinity(), last = 0;
    for (const glm::dvec2 p : points) {
        if (!positive(p)) continue;
        const double x = std::log(p.x), y = std::log(p.y);
        n += 1;
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
        first = std::min(first, p.x);
        last = std::max(last, p.x);
    }
    if (n < 2 || first == last) return {};
    PowerFit fit;
    fit.exponent = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
    const double offset = (sum_y - fit.exponent * sum_x) / n;
    fit.factor = std::exp(offset);
    fit.first = first;
    fit.last = last;
    fit.points = static_cast<std::size_t>(n);
    for (const glm::dvec2 p : points) {
        if (!positive(p)) continue;
        const double residual = std::log(p.y) - offset - fit.exponent * std::log(p.x);
        fit.deviation += residual * residual / n;
    }
    fit.deviation = std::sqrt(fit.deviation);
    return fit;
}

double first_reach(std::span<const glm::dvec2> points, double target) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].y > target) continue;
        if (i == 0) return points[0].x;
        const glm::dvec2 a = points[i - 1], b = points[i];
        return between({a.y, a.x}, {b.y, b.x}, target);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double interpolate_log(std::span<const glm::dvec2> points, double x) {
    TYNDALL_CHECK(!points.empty());
    if (x <= points.front().x) return points.front().y;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (x <= points[i].x) return between(points[i - 1], points[i], x);
    return points.back().y;
}

double geometric_mean(std::span<const double> values) {
    TYNDALL_CHECK(!values.empty());
    double sum = 0;
    for (const double v : values) sum += std::log(v);
    return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace tyndall::bench
