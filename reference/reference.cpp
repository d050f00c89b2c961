#include "reference/reference.h"

#include <algorithm>
#include <limits>

#include "reference/inscatter.h"
#include "reference/surface.h"

namespace tyndall::reference {

struct Reference::Impl {
    const Scene& scene;
    Settings settings;
    Geometry geometry;
    Media media;
    Sky sky;
    Lighting lighting;
    InScattering scattering;

    Impl(const Scene& scene_, const Settings& settings_)
        : scene(scene_),
          settings(settings_),
          geometry(scene, settings.shadows),
          media(scene.media),
          sky(scene, settings.ambient),
          lighting{scene_suns(scene), scene_lamps(scene), sky.mean_radiance()},
          scattering(geometry, media, lighting, settings) {}

    [[nodiscard]] dvec3 surface_radiance(const Geometry::Hit& hit, dvec3 origin, dvec3 direction) const;
    /// What is left of a light after what lies between: 0 behind what blocks it, a colour behind glass.
    [[nodiscard]] dvec3 visible(const Surface& surface, bool casts, dvec3 to_light, double distance) const;
};

namespace {

/// How far from a surface its own triangles, and those in the same plane, are not asked: corners are in single
/// precision. m.
double skip_at(dvec3 position) {
    const double farthest = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    return 1e-6 * std::max(1.0, farthest);
}

}  // namespace

dvec3 Reference::Impl::visible(const Surface& surface, bool casts, dvec3 to_light, double distance) const {
    if (!settings.shadows || !casts) return dvec3(1);
    if (glm::dot(surface.geometric_normal, to_light) <= 0) return dvec3(0);
    const double skip = skip_at(surface.position);
    const dvec3 from = surface.position + skip * surface.geometric_normal;
    if (geometry.occluded(from, to_light, distance, skip)) return dvec3(0);
    return geometry.tint(from, to_light, distance, skip);
}

dvec3 Reference::Impl::surface_radiance(const Geometry::Hit& hit, dvec3 origin, dvec3 direction) const {
    const Surface surface = surface_at(scene, geometry, hit, origin, direction);
    const dvec3 to_eye = -direction;
    dvec3 radiance = surface.emissive;
    for (const Sun& sun : lighting.suns) {
        dvec3 share = reflected(surface, to_eye, sun.to_sun);
        if (share != dvec3(0))
            share *= visible(surface, sun.shadow, sun.to_sun, std::numeric_limits<double>::infinity());
        if (share != dvec3(0))
            radiance += sun.illuminance * share *
                        scattering.towards_sun(surface.position, sun.to_sun, scattering.depth_tolerance());
    }
    for (const Lamp& lamp : lighting.lamps) {
        const dvec3 offset = surface.position - lamp.position;
        const dvec3 illuminance = lamp.illuminance(offset);
        const double distance = glm::length(offset);
        if (illuminance == dvec3(0) || distance == 0) continue;
        const dvec3 to_lamp = -offset / distance;
        dvec3 share = reflected(surface, to_eye, to_lamp);
        if (share != dvec3(0)) share *= visible(surface, lamp.shadow, to_lamp, distance);
        if (share != dvec3(0))
            radiance += illuminance * share *
                        scattering.towards_lamp(surface.position, to_lamp, distance, scattering.depth_tolerance());
    }
    if (settings.ambient > 0) radiance += sky.reflected(surface, to_eye);
    return radiance;
}

Reference::Reference(const Scene& scene, const Settings& settings)
    : impl_(std::make_unique<Impl>(scene, settings)) {}
Reference::~Reference() = default;

double Reference::visible_distance(dvec3 origin, dvec3 unit_direction, double begin) const {
    const auto hit = impl_->geometry.closest_hit(origin, unit_direction, begin);
    return hit ? hit->distance : std::numeric_limits<double>::infinity();
}

Reference::Ray Reference::trace(dvec3 origin, dvec3 unit_direction, double begin) const {
    const Impl& i = *impl_;
    const auto hit = i.geometry.closest_hit(origin, unit_direction, begin);
    Ray ray;
    ray.distance = hit ? hit->distance : std::numeric_limits<double>::infinity();
    const MediaRay media(i.media, origin, unit_direction, ray.distance, i.scattering.depth_tolerance());
    const InScattering::Result scattered = i.scattering.along(media, origin, unit_direction);
    ray.scattering = scattered.radiance;
    ray.error = scattered.error;
    ray.transmittance = glm::exp(-media.depth(ray.distance));
    if (!hit && !i.settings.black_sky) ray.background = i.sky.background(unit_direction);
    if (hit && !i.settings.black_surfaces) ray.background = i.surface_radiance(*hit, origin, unit_direction);
    return ray;
}

}  // namespace tyndall::reference
