#pragma once

#include <vector>

#include "engine/scene/scene.h"
#include "reference/geometry.h"

namespace tyndall::reference {

struct Sun {
    dvec3 to_sun;       ///< unit
    dvec3 illuminance;  ///< lux
    bool shadow;
};
/// Those that shine.
[[nodiscard]] std::vector<Sun> scene_suns(const Scene& scene);

/// A point or spot lamp of KHR_lights_punctual, with a radius within which it gets no brighter.
struct Lamp {
    dvec3 position, axis;  ///< axis: unit, the way it shines
    dvec3 intensity;       ///< cd
    double range;          ///< m; may be infinite
    double radius;         ///< m
    bool spot, shadow;
    double cos_outer, cone_scale;

    /// Of the intensity, per m²: (1 - (d / range)^4) / max(d², radius²), 0 from the range on.
    [[nodiscard]] double attenuation(double distance_squared) const;
    /// clamp((cos - cos_outer) * scale, 0, 1)², scale = 1 / (cos_inner - cos_outer), of which a thousandth of
    /// 1 - cos_outer is the least; 1 for a point lamp.
    [[nodiscard]] double cone(double cos_angle) const;
    /// Illuminance at an offset from the lamp on a plane that faces it, lux.
    [[nodiscard]] dvec3 illuminance(dvec3 offset) const;
};
/// Those that shine.
[[nodiscard]] std::vector<Lamp> scene_lamps(const Scene& scene);

/// A lamp as a ray passes it: d² = h² + u², u = t - nearest.
struct LampPath {
    const Lamp* lamp;
    double nearest;  ///< distance along the ray
    double h;        ///< m
    dvec3 passing;   ///< from the lamp to the nearest point
    dvec3 direction;

    LampPath(const Lamp& lamp, dvec3 origin, dvec3 unit_direction);
    /// What of [begin, end] lies within the lamp's range; begin >= end: nothing.
    [[nodiscard]] Interval within_range(double begin, double end) const;
    /// Distances along the ray where the lamp's light has kinks: nearest point, radius, cone.
    [[nodiscard]] std::vector<double> kinks() const;
    /// The integral of 1 / max(d², radius²) over a part of the ray, 1/m: a bound of that of the attenuation.
    [[nodiscard]] double inverse_square(Interval part) const;

    // Equi-angular variable v = atan2(h, |u|) / h on one side of the nearest point: dv = |du| / (h² + u²), and it
    // holds to h = 0, where it is 1 / |u|.
    [[nodiscard]] double to_angle(double u) const;
    [[nodiscard]] double from_angle(double v) const;  ///< |u|
};

}  // namespace tyndall::reference
