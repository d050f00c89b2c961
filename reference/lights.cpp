#include "reference/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::reference {
namespace {

constexpr double least_radius = 1e-3;  ///< m: 1/d² has no finite integral through a point

/// Of its node, without scale.
glm::mat4 world_of(const Scene& scene, const Light& light) {
    return node_pose(scene, light.node);
}

/// A light shines along its node's -Z.
dvec3 axis_of(const glm::mat4& world) {
    return -glm::normalize(dvec3(world[2]));
}

bool shines(const Light& light) {
    return light.node >= 0 && (light.intensity.x > 0 || light.intensity.y > 0 || light.intensity.z > 0);
}

double square(double x) {
    return x * x;
}

}  // namespace

std::vector<Sun> scene_suns(const Scene& scene) {
    std::vector<Sun> suns;
    for (const Light& light : scene.lights)
        if (light.type == LightType::sun && shines(light))
            suns.push_back({-axis_of(world_of(scene, light)), dvec3(light.intensity), light.shadow});
    return suns;
}

std::vector<Lamp> scene_lamps(const Scene& scene) {
    std::vector<Lamp> lamps;
    for (const Light& light : scene.lights) {
        if (light.type == LightType::sun || !shines(light)) continue;
        const glm::mat4 world = world_of(scene, light);
        const double cos_inner = std::cos(static_cast<double>(light.inner_cone));
        const double cos_outer = std::cos(static_cast<double>(light.outer_cone));
        lamps.push_back({.position = dvec3(world[3]),
                         .axis = axis_of(world),
                         .intensity = dvec3(light.intensity),
                         .range = light.range > 0 ? light.range : std::numeric_limits<double>::infinity(),
                         .radius = std::max<double>(light.radius, least_radius),
                         .spot = light.type == LightType::spot,
                         .shadow = light.shadow,
                         .cos_outer = cos_outer,
                         .cone_scale = 1 / std::max(0.001 * (1 - cos_outer), cos_inner - cos_outer)});
    }
    return lamps;
}

double Lamp::attenuation(double distance_squared) const {
    const double window = 1 - square(distance_squared / square(range));
    return std::clamp(window, 0.0, 1.0) / std::max(distance_squared, square(radius));
}

double Lamp::cone(double cos_angle) const {
    return spot ? square(std::clamp((cos_angle - cos_outer) * cone_scale, 0.0, 1.0)) : 1;
}

dvec3 Lamp::illuminance(dvec3 offset) const {
    const double squared = glm::dot(offset, offset);
    const double distance = std::sqrt(squared);
    const double cos_angle = distance > 0 ? glm::dot(offset, axis) / distance : 1;
    return intensity * (attenuation(squared) * cone(cos_angle));
}

LampPath::LampPath(const Lamp& lamp_, dvec3 origin, dvec3 unit_direction)
    : lamp(&lamp_),
      nearest(glm::dot(lamp_.position - origin, unit_direction)),
      passing(origin - lamp_.position + nearest * unit_direction),
      direction(unit_direction) {
    h = glm::length(passing);
}

Interval LampPath::within_range(double begin, double end) const {
    const double room = square(lamp->range) - h * h;
    if (!(room > 0)) return {end, begin};
    const double half = std::sqrt(room);
    return {std::max(begin, nearest - half), std::min(end, nearest + half)};
}

std::vector<double> LampPath::kinks() const {
    std::vector<double> kinks{nearest};
    if (h < lamp->radius) {
        const double half = std::sqrt(square(lamp->radius) - h * h);
        kinks.insert(kinks.end(), {nearest - half, nearest + half});
    }
    if (!lamp->spot) return kinks;
    // Cone of cosine c: A u + B = c sqrt(u² + h²), squared; of the roots some belong to the opposite cone.
    const double A = glm::dot(direction, lamp->axis), B = glm::dot(passing, lamp->axis);
    for (const double c : {lamp->cos_outer, lamp->cos_outer + 1 / lamp->cone_scale}) {
        const double a = A * A - c * c, half_b = A * B, k = B * B - square(c * h);
        const double discriminant = half_b * half_b - a * k;
        if (discriminant < 0) continue;
        const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
        for (const double u : {q / a, k / q})
            if (std::isfinite(u)) kinks.push_back(nearest + u);
    }
    return kinks;
}

double LampPath::to_angle(double u) const {
    return h > 0 ? std::atan2(h, std::abs(u)) / h : 1 / std::abs(u);
}

double LampPath::from_angle(double v) const {
    return h > 0 ? h / std::tan(h * v) : 1 / v;
}

double LampPath::inverse_square(Interval part) const {
    const double chord = std::sqrt(std::max(square(lamp->radius) - h * h, 0.0));
    const auto from_nearest = [&](double u) {  // over [0, |u|], with the sign of u
        const double inside = std::min(std::abs(u), chord);
        double sum = chord > 0 ? inside / square(lamp->radius) : 0;
        if (std::abs(u) > chord) sum += to_angle(chord) - to_angle(u);
        return std::copysign(sum, u);
    };
    return from_nearest(part.end - nearest) - from_nearest(part.begin - nearest);
}

}  // namespace tyndall::reference
