#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall::reference {

/// An integral and its estimated absolute error, per channel.
template <class V>
struct Integral {
    V value{0}, error{0};
};

/// A part [a, b] of what is integrated; `source` tells integrands apart that share one error budget.
template <class V>
struct Panel {
    double a, b;
    int source = 0;
    Integral<V> integral{};
};

namespace quadrature {

inline double magnitude(double v) {
    return std::abs(v);
}
inline glm::dvec3 magnitude(glm::dvec3 v) {
    return glm::abs(v);
}
inline double largest(double v) {
    return v;
}
inline double largest(glm::dvec3 v) {
    return std::max({v.x, v.y, v.z});
}

// Piessens et al. 1983, QUADPACK: the difference of the two rules is the error of the 7-point one. That of the
// 15-point one is estimated by spread * min(1, (200 difference / spread)^1.5), spread = int |f - mean f|.
inline double sharpened(double difference, double spread) {
    if (difference <= 0 || spread <= 0) return difference;
    const double ratio = 200 * difference / spread;
    return spread * std::min(1.0, ratio * std::sqrt(ratio));
}
inline glm::dvec3 sharpened(glm::dvec3 difference, glm::dvec3 spread) {
    return {sharpened(difference.x, spread.x), sharpened(difference.y, spread.y),
            sharpened(difference.z, spread.z)};
}

// Nodes x > 0 of the 15-point Kronrod rule on [-1, 1], largest first, and 0; the odd ones are Gauss's 7.
inline constexpr std::array<double, 8> nodes{
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693139, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
inline constexpr std::array<double, 8> kronrod_weights{
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
    0.140653259715525918745189590510238, 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
inline constexpr std::array<double, 4> gauss_weights{
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780, 0.381830050505118944950369775488975,
    0.417959183673469387755102040816327};

}  // namespace quadrature

/// The Gauss-Kronrod rule of 7 and 15 points over [a, b]; exact for polynomials up to degree 22. V: double or
/// dvec3.
template <class V, class F>
[[nodiscard]] Integral<V> gauss_kronrod(F&& f, double a, double b) {
    namespace q = quadrature;
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    std::array<V, 15> values;
    values[14] = f(middle);
    V kronrod = q::kronrod_weights[7] * values[14];
    V gauss = q::gauss_weights[3] * values[14];
    for (std::size_t i = 0; i < 7; ++i) {
        const V left = values[2 * i] = f(middle - half * q::nodes[i]);
        const V right = values[2 * i + 1] = f(middle + half * q::nodes[i]);
        kronrod += q::kronrod_weights[i] * (left + right);
        if (i % 2 == 1) gauss += q::gauss_weights[i / 2] * (left + right);
    }
    const V mean = 0.5 * kronrod;
    V spread = q::kronrod_weights[7] * q::magnitude(values[14] - mean);
    for (std::size_t i = 0; i < 7; ++i)
        spread +=
            q::kronrod_weights[i] * (q::magnitude(values[2 * i] - mean) + q::magnitude(values[2 * i + 1] - mean));
    const double size = std::abs(half);
    return {half * kronrod, q::sharpened(size * q::magnitude(kronrod - gauss), size * spread)};
}

/// How exact a sum of panels must be: the largest channel's error at most max(absolute, relative * largest value),
/// or `most` panels are in use.
struct Accuracy {
    double absolute, relative;
    std::size_t most = 20000;
};

/// Sums the integrals of f(source, x) over the panels, which must have been integrated once, and halves whichever
/// has the greatest error until the sum is exact enough. `panels` is what it ended with.
template <class V, class F>
Integral<V> refine(F&& f, std::vector<Panel<V>>& panels, const Accuracy& accuracy) {
    namespace q = quadrature;
    const auto less = [](const Panel<V>& l, const Panel<V>& r) {
        return q::largest(l.integral.error) < q::largest(r.integral.error);
    };
    const auto total = [&] {
        Integral<V> sum;
        for (const Panel<V>& p : panels) sum.value += p.integral.value, sum.error += p.integral.error;
        return sum;
    };
    std::make_heap(panels.begin(), panels.end(), less);
    Integral<V> sum = total();
    const auto good_enough = [&] {
        return q::largest(sum.error) <=
               std::max(accuracy.absolute, accuracy.relative * q::largest(q::magnitude(sum.value)));
    };
    while (!panels.empty() && panels.size() < accuracy.most && !good_enough()) {
        std::pop_heap(panels.begin(), panels.end(), less);
        Panel<V> left = panels.back();
        const double middle = 0.5 * (left.a + left.b);
        if (!(left.a < middle && middle < left.b)) {  // down to rounding
            std::push_heap(panels.begin(), panels.end(), less);
            break;
        }
        panels.pop_back();
        Panel<V> right{middle, left.b, left.source};
        sum.value -= left.integral.value, sum.error -= left.integral.error;
        left.b = middle;
        for (Panel<V>* p : {&left, &right}) {
            p->integral = gauss_kronrod<V>([&](double x) { return f(p->source, x); }, p->a, p->b);
            sum.value += p->integral.value, sum.error += p->integral.error;
            panels.push_back(*p);
            std::push_heap(panels.begin(), panels.end(), less);
        }
        if (good_enough()) sum = total();  // without what rounding left of differences
    }
    return total();
}

/// The integral of f between the first and the last of the rising `points`, which are where f has edges and kinks.
template <class V, class F>
[[nodiscard]] Integral<V> integrate(F&& f, std::span<const double> points, const Accuracy& accuracy) {
    std::vector<Panel<V>> panels;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        if (points[i] < points[i + 1])
            panels.push_back({points[i], points[i + 1], 0, gauss_kronrod<V>(f, points[i], points[i + 1])});
    return refine<V>([&](int, double x) { return f(x); }, panels, accuracy);
}

}  // namespace tyndall::reference
