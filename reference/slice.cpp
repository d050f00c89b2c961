#include "reference/slice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tyndall::reference {
namespace {

constexpr double smallest_angle = 1e-7;  // rad, between ray and light: below, rounding shows in t
/// Along the light, m: what lies this near to the ray or to the lamp darkens nothing. A lamp hangs on a ceiling, a
/// ray runs along a floor.
constexpr double at_ray = 1e-9, at_lamp = 1e-6;

/// The point of an edge that lies in the plane; the same for both triangles of an edge, to the last bit.
struct Crossing {
    dvec3 point;
    dvec3 weights;  ///< of the triangle's corners
};

Crossing crossing(const Caster& caster, const std::array<double, 3>& height, std::size_t i, std::size_t j) {
    if (height[i] < 0) std::swap(i, j);
    const double u = height[i] / (height[i] - height[j]);
    Crossing c{caster.corner[i] + u * (caster.corner[j] - caster.corner[i]), dvec3(0)};
    c.weights[static_cast<int>(i)] = 1 - u;
    c.weights[static_cast<int>(j)] = u;
    return c;
}

/// A stretch of a ray shorter than this is a product of rounding, at a distance t; m.
double rounding(double t) {
    return 1e-9 * std::max(1.0, std::abs(t));
}

double lerp(double a, double b, double u) {
    return a * (1 - u) + b * u;
}

/// Keeps of [part.begin, part.end] where the linear function with values a at 0 and b at 1 is not negative.
void clip(Interval& part, double a, double b) {
    if (a >= 0 && b >= 0) return;
    if (a < 0 && b < 0) {
        part.end = -1;
        return;
    }
    const double zero = a / (a - b);
    if (a < 0)
        part.begin = std::max(part.begin, zero);
    else
        part.end = std::min(part.end, zero);
}

}  // namespace

std::optional<Slice> sun_slice(dvec3 origin, dvec3 unit_direction, double begin, double end, dvec3 to_sun) {
    const dvec3 across = glm::cross(unit_direction, to_sun);
    const double sine = glm::length(across);
    if (sine < smallest_angle) return {};
    // p - origin = t d + s l: dotted with l × n and n × d this leaves t and s, times the sine.
    const dvec3 n = across / sine;
    return Slice{{origin, n},
                 {origin, glm::cross(n, unit_direction), -at_ray * sine},
                 {origin, glm::cross(to_sun, n)},
                 {origin, dvec3(0), sine},
                 0,
                 begin,
                 end};
}

std::optional<Slice> lamp_slice(dvec3 origin, dvec3 unit_direction, double begin, double end, dvec3 lamp) {
    const dvec3 to_lamp = lamp - origin;
    const dvec3 across = glm::cross(unit_direction, to_lamp);
    const double distance = glm::length(across);  // of the lamp from the ray
    const double sine = distance / std::max(glm::length(to_lamp), 1e-12);
    if (sine < smallest_angle || distance < 1e-12) return {};
    // origin + t d, the lamp and p lie on a line: (p - lamp) × (t d - to_lamp) · n = 0.
    const dvec3 n = across / distance;
    return Slice{{origin, n},
                 {origin, glm::cross(n, unit_direction), -std::min(at_ray * sine, 1e-3 * distance)},
                 {lamp, glm::cross(to_lamp, n)},
                 {lamp, glm::cross(unit_direction, n)},
                 std::min(at_lamp * sine, 1e-3 * distance),
                 begin,
                 end};
}

std::optional<Shadow> cut(const Caster& caster, const Slice& slice) {
    const std::array<double, 3> height{slice.plane(caster.corner[0]), slice.plane(caster.corner[1]),
                                       slice.plane(caster.corner[2])};
    const bool side[3] = {height[0] >= 0, height[1] >= 0, height[2] >= 0};
    if (side[0] == side[1] && side[1] == side[2]) return {};
    const std::size_t lone = side[0] == side[1] ? 2 : side[0] == side[2] ? 1 : 0;
    const Crossing p = crossing(caster, height, lone, (lone + 1) % 3);
    const Crossing q = crossing(caster, height, lone, (lone + 2) % 3);

    Shadow s{{0, 1},
             {slice.numerator(p.point), slice.numerator(q.point)},
             {slice.denominator(p.point), slice.denominator(q.point)},
             {p.weights, q.weights}};
    const auto& [numerator, denominator] = std::tie(s.numerator, s.denominator);
    clip(s.part, slice.above(p.point), slice.above(q.point));
    clip(s.part, denominator[0] - slice.nearest, denominator[1] - slice.nearest);
    clip(s.part, numerator[0] - slice.begin * denominator[0], numerator[1] - slice.begin * denominator[1]);
    clip(s.part, slice.end * denominator[0] - numerator[0], slice.end * denominator[1] - numerator[1]);
    if (s.part.begin > s.part.end) return {};
    return s;
}

double Shadow::ray_at(double u) const {
    return lerp(numerator[0], numerator[1], u) / lerp(denominator[0], denominator[1], u);
}

dvec3 Shadow::weights_at(double t) const {
    // Zero where u darkens t, and linear in u.
    const double a = numerator[0] - t * denominator[0], b = numerator[1] - t * denominator[1];
    const double u = a == b ? 0 : std::clamp(a / (a - b), 0.0, 1.0);
    return weights[0] * (1 - u) + weights[1] * u;
}

Interval Shadow::on_ray(Interval stretch, const Slice& slice) const {
    const auto t = [&](double u) { return std::clamp(ray_at(u), slice.begin, slice.end); };
    const double a = t(stretch.begin), b = t(stretch.end);
    return {std::min(a, b), std::max(a, b)};
}

void merge(std::vector<Interval>& intervals) {
    std::ranges::sort(intervals, {}, &Interval::begin);
    std::size_t last = 0;
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        if (intervals[i].begin <= intervals[last].end + rounding(intervals[last].end))
            intervals[last].end = std::max(intervals[last].end, intervals[i].end);
        else
            intervals[++last] = intervals[i];
    }
    if (!intervals.empty()) intervals.resize(last + 1);
}

std::vector<Interval> lit_between(const std::vector<Interval>& dark, double begin, double end) {
    if (dark.empty()) return {{begin, end}};
    std::vector<Interval> lit;
    const auto add = [&](double from, double to) {
        if (to - from > rounding(from)) lit.push_back({from, to});
    };
    for (const Interval& shadow : dark) {
        add(begin, shadow.begin);
        begin = shadow.end;
    }
    add(begin, end);
    return lit;
}

}  // namespace tyndall::reference
