#include "reference/inscatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "reference/phase.h"
#include "reference/quadrature.h"
#include "reference/tint.h"

namespace tyndall::reference {
namespace {

double largest(const dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// One integrand of a ray. Lamps are integrated in distance within the sphere of their radius, and in the angle
/// under which the lamp sees the ray before and behind their nearest point.
struct Source {
    enum class Kind { glow, sun, lamp_inside, lamp_before, lamp_behind };
    Kind kind;
    int light = -1;  ///< index of a sun or a LampPath
    int tint = -1;   ///< index of the light's
};

}  // namespace

/// The sum over all sources of one ray.
struct InScattering::RaySum {
    const InScattering& in;
    const MediaRay& ray;
    dvec3 origin, direction;
    std::vector<LampPath> lamps{};
    std::vector<Tint> tints{};
    std::vector<Source> sources{};
    std::vector<Panel<dvec3>> panels{};
    dvec3 sum{0};  ///< of the panels as first integrated

    [[nodiscard]] double phase_peak() const {
        const double particles = in.settings_.phase.peak(ray.greatest_anisotropy());
        return ray.has_air() ? std::max(particles, rayleigh_peak()) : particles;
    }
    [[nodiscard]] dvec3 glow(double t) const {
        const MediumPoint m = ray.at(t);
        return glm::exp(-ray.depth(t)) * (m.emission + m.sigma_s * in.lighting_.ambient);
    }
    [[nodiscard]] dvec3 sunlight(const Sun& sun, const Tint& tint, double t) const {
        const MediumPoint m = ray.at(t);
        const dvec3 filter = tint.at(t);
        if (m.sigma_s * filter == dvec3(0)) return dvec3(0);
        return filter * glm::exp(-ray.depth(t)) * sun.illuminance *
               in.scattered(m, glm::dot(sun.to_sun, direction)) *
               in.towards_sun(origin + t * direction, sun.to_sun, in.averaged());
    }
    /// At u metres behind the point nearest to the lamp, times `weight`, m².
    [[nodiscard]] dvec3 lamplight(const LampPath& path, const Tint& tint, double u, double weight) const {
        const double t = path.nearest + u;
        const MediumPoint m = ray.at(t);
        const dvec3 offset = path.passing + u * direction;
        const double distance = std::sqrt(path.h * path.h + u * u);
        const dvec3 filter = tint.at(t);
        if (m.sigma_s * filter == dvec3(0)) return dvec3(0);
        const Lamp& lamp = *path.lamp;
        const double cos_axis = distance > 0 ? glm::dot(offset, lamp.axis) / distance : 1;
        const double strength = lamp.attenuation(distance * distance) * lamp.cone(cos_axis) * weight;
        if (strength <= 0) return dvec3(0);
        const dvec3 to_lamp = distance > 0 ? -offset / distance : -direction;
        return filter * glm::exp(-ray.depth(t)) * lamp.intensity *
               in.scattered(m, distance > 0 ? -u / distance : 0.0) *
               in.towards_lamp(origin + t * direction, to_lamp, distance, in.averaged()) * strength;
    }
    [[nodiscard]] dvec3 evaluate(int source, double x) const {
        const Source& s = sources[static_cast<std::size_t>(source)];
        if (s.kind == Source::Kind::glow) return glow(x);
        const auto index = static_cast<std::size_t>(s.light);
        const Tint& tint = tints[static_cast<std::size_t>(s.tint)];
        if (s.kind == Source::Kind::sun) return sunlight(in.lighting_.suns[index], tint, x);
        const LampPath& path = lamps[index];
        if (s.kind == Source::Kind::lamp_inside) return lamplight(path, tint, x - path.nearest, 1);
        const double u = path.from_angle(x);
        return lamplight(path, tint, s.kind == Source::Kind::lamp_before ? -u : u, path.h * path.h + u * u);
    }

    int add_tint(Tint tint) {
        tints.push_back(std::move(tint));
        return static_cast<int>(tints.size()) - 1;
    }
    int add_source(Source source) {
        sources.push_back(source);
        return static_cast<int>(sources.size()) - 1;
    }
    void add_panel(int source, double a, double b) {
        if (!(a < b)) return;
        panels.push_back({a, b, source, gauss_kronrod<dvec3>([&](double x) { return evaluate(source, x); }, a, b)});
        sum += panels.back().integral.value;
    }
    /// The interval's ends and what of the media's knots and of `more` lies between.
    [[nodiscard]] std::vector<double> split(const Interval& part, const std::vector<double>& more) const {
        std::vector<double> points{part.begin, part.end};
        for (const std::vector<double>* list : {&ray.knots(), &more})
            for (const double t : *list)
                if (t > part.begin && t < part.end) points.push_back(t);
        std::sort(points.begin(), points.end());
        return points;
    }

    void add_glow() {
        const int source = add_source({Source::Kind::glow});
        const std::vector<double> points = split({0, ray.end()}, {});
        for (std::size_t i = 0; i + 1 < points.size(); ++i) add_panel(source, points[i], points[i + 1]);
    }
    void add_sun(int index) {
        const Sun& sun = in.lighting_.suns[static_cast<std::size_t>(index)];
        std::vector<Interval> lit{{0, ray.end()}};
        Tint tint;
        if (in.settings_.shadows && sun.shadow) {
            lit = in.geometry_.lit_by_sun(origin, direction, 0, ray.end(), sun.to_sun);
            tint = in.geometry_.tint_by_sun(origin, direction, 0, ray.end(), sun.to_sun);
        }
        const std::vector<double> edges = tint.knots();
        const int source = add_source({Source::Kind::sun, index, add_tint(std::move(tint))});
        for (const Interval& part : lit) {
            const std::vector<double> points = split(part, edges);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) add_panel(source, points[i], points[i + 1]);
        }
    }
    void add_lamp(const LampPath& path, const Interval& reach) {
        std::vector<Interval> lit{reach};
        Tint tint;
        if (in.settings_.shadows && path.lamp->shadow) {
            const dvec3 lamp = path.lamp->position;
            lit = in.geometry_.lit_by_lamp(origin, direction, reach.begin, reach.end, lamp);
            tint = in.geometry_.tint_by_lamp(origin, direction, reach.begin, reach.end, lamp);
        }
        const int index = static_cast<int>(lamps.size());
        lamps.push_back(path);
        std::vector<double> kinks = path.kinks();
        const std::vector<double> edges = tint.knots();
        kinks.insert(kinks.end(), edges.begin(), edges.end());
        const int tinted = add_tint(std::move(tint));
        const int inside = add_source({Source::Kind::lamp_inside, index, tinted});
        const int before = add_source({Source::Kind::lamp_before, index, tinted});
        const int behind = add_source({Source::Kind::lamp_behind, index, tinted});
        for (const Interval& part : lit) {
            const std::vector<double> points = split(part, kinks);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const double a = points[i] - path.nearest, b = points[i + 1] - path.nearest;
                const double u = 0.5 * (a + b);
                if (path.h * path.h + u * u < path.lamp->radius * path.lamp->radius)
                    add_panel(inside, points[i], points[i + 1]);
                else if (u > 0)
                    add_panel(behind, path.to_angle(b), path.to_angle(a));
                else
                    add_panel(before, path.to_angle(a), path.to_angle(b));
            }
        }
    }
    /// Lamps by what they can give at most, greatest first; the last ones are left out as long as all of them
    /// together stay within their share of the tolerance. Returns their bound.
    double add_lamps() {
        struct Candidate {
            LampPath path;
            Interval reach;
            double bound;
        };
        std::vector<Candidate> candidates;
        const double scatter = largest(ray.greatest_sigma_s()) * phase_peak();
        for (const Lamp& lamp : in.lighting_.lamps) {
            const LampPath path(lamp, origin, direction);
            const Interval reach = path.within_range(0, ray.end());
            if (!(reach.begin < reach.end)) continue;
            const double bound = scatter * largest(lamp.intensity) * path.inverse_square(reach);
            if (bound > 0) candidates.push_back({path, reach, bound});
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& l, const Candidate& r) { return l.bound > r.bound; });
        double left = std::accumulate(candidates.begin(), candidates.end(), 0.0,
                                      [](double s, const Candidate& c) { return s + c.bound; });
        for (const Candidate& c : candidates) {
            if (left <= budget_left_out * in.settings_.tolerance * std::max(largest(sum), in.settings_.floor))
                return left;
            add_lamp(c.path, c.reach);
            left = std::max(left - c.bound, 0.0);
        }
        return 0;
    }
};

InScattering::InScattering(const Geometry& geometry, const Media& media, const Lighting& lighting,
                           const Settings& settings)
    : geometry_(geometry), media_(media), lighting_(lighting), settings_(settings) {}

dvec3 InScattering::scattered(const MediumPoint& m, double cos_theta) const {
    return (m.sigma_s - m.air) * settings_.phase(m.anisotropy, cos_theta) + m.air * rayleigh(cos_theta);
}

dvec3 InScattering::towards_sun(dvec3 point, dvec3 to_sun, const DepthTolerance& tolerance) const {
    if (!settings_.light_transmittance) return dvec3(1);
    return glm::exp(
        -media_.optical_depth(point, to_sun, 0, std::numeric_limits<double>::infinity(), false, tolerance));
}

dvec3 InScattering::towards_lamp(dvec3 point, dvec3 to_lamp, double distance,
                                 const DepthTolerance& tolerance) const {
    if (!settings_.light_transmittance) return dvec3(1);
    return glm::exp(-media_.optical_depth(point, to_lamp, 0, distance, true, tolerance));
}

InScattering::Result InScattering::along(const MediaRay& ray, dvec3 origin, dvec3 unit_direction) const {
    if (media_.empty() || !(ray.end() > 0)) return {};
    RaySum sum{*this, ray, origin, unit_direction};
    sum.add_glow();
    double left_out = 0;
    if (ray.greatest_sigma_s() != dvec3(0)) {
        for (std::size_t i = 0; i < lighting_.suns.size(); ++i) sum.add_sun(static_cast<int>(i));
        left_out = sum.add_lamps();
    }
    const double tolerance = budget_quadrature * settings_.tolerance;
    const Integral<dvec3> all = refine<dvec3>([&](int source, double x) { return sum.evaluate(source, x); },
                                              sum.panels, {tolerance * settings_.floor, tolerance});
    const double radiance = largest(all.value);
    const double noise = ray.noisy() && settings_.light_transmittance ? budget_noise * settings_.tolerance : 0;
    return {all.value, largest(all.error) + left_out + (2 * depth_tolerance() + noise) * radiance};
}

}  // namespace tyndall::reference
