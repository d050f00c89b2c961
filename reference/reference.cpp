#include "reference/reference.h"

#include <limits>

#include "reference/inscatter.h"
#include "reference/sky_light.h"
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
    SkyLight sky_light;

    Impl(const Scene& scene_, const Settings& settings_)
        : scene(scene_),
          settings(settings_),
          geometry(scene, settings.shadows),
          media(scene.media),
          sky(scene, settings.ambient),
          lighting{scene_suns(scene), scene_lamps(scene), settings.sky_visibility ? dvec3(0) : sky.mean_radiance()},
          scattering(geometry, media, lighting, settings),
          sky_light(sky.table(), geometry, scattering, settings) {}

    [[nodiscard]] dvec3 surface_radiance(const Geometry::Hit& hit, dvec3 origin, dvec3 direction) const;
};

dvec3 Reference::Impl::surface_radiance(const Geometry::Hit& hit, dvec3 origin, dvec3 direction) const {
    const Surface surface = surface_at(scene, geometry, hit, origin, direction);
    const dvec3 to_eye = -direction;
    dvec3 radiance = surface.emissive;
    for (const Sun& sun : lighting.suns) {
        dvec3 share = reflected(surface, to_eye, sun.to_sun);
        if (share != dvec3(0) && sun.shadow)
            share *= visible(geometry, surface, sun.to_sun, std::numeric_limits<double>::infinity());
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
        if (share != dvec3(0) && lamp.shadow) share *= visible(geometry, surface, to_lamp, distance);
        if (share != dvec3(0))
            radiance += illuminance * share *
                        scattering.towards_lamp(surface.position, to_lamp, distance, scattering.depth_tolerance());
    }
    if (settings.ambient > 0)
        radiance += settings.sky_visibility ? sky_light.reflected(surface, to_eye) : sky.reflected(surface, to_eye);
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
    if (i.settings.sky_visibility && i.settings.ambient > 0) {
        const InScattering::Result from_sky = i.sky_light.along(media, origin, unit_direction);
        ray.scattering += from_sky.radiance;
        ray.error += from_sky.error;
    }
    ray.transmittance = glm::exp(-media.depth(ray.distance));
    if (!hit && !i.settings.black_sky) ray.background = i.sky.background(unit_direction);
    if (hit && !i.settings.black_surfaces) ray.background = i.surface_radiance(*hit, origin, unit_direction);
    return ray;
}

}  // namespace tyndall::reference
