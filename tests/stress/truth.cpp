#include "truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw_scene.h"
#include "moderate.h"

namespace tyndall::stress {
namespace {

Scene as_known(Scene scene, const Knows& known) {
    if (!known.local) std::erase_if(scene.media, is_bounded);
    if (!known.lamps)
        for (Light& light : scene.lights)
            if (light.type != LightType::sun) light.intensity = glm::vec3(0);
    return scene;
}

std::vector<Medium> local_of(std::vector<Medium> media) {
    std::erase_if(media, [](const Medium& medium) { return !is_bounded(medium); });
    return media;
}

std::vector<Medium> without_noise(std::vector<Medium> media) {
    for (Medium& medium : media) medium.noise_amount = 0;
    return media;
}

bool casts_shadows(const Scene& scene) {
    return std::ranges::any_of(scene.lights,
                               [](const Light& l) { return l.shadow && l.intensity != glm::vec3(0); });
}

}  // namespace

PixelRay pixel_ray(const View& view, glm::dvec2 size, glm::dvec2 pixel) {
    const double tan_y = 1 / static_cast<double>(view.projection[1][1]);
    const double tan_x = 1 / static_cast<double>(view.projection[0][0]);
    const dvec3 local((2 * (pixel.x + 0.5) / size.x - 1) * tan_x, (1 - 2 * (pixel.y + 0.5) / size.y) * tan_y, -1);
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(glm::mat3(view.view)));
    return {dvec3(view.eye), glm::normalize(to_world * local), view.znear * glm::length(local),
            1 / glm::length(local)};
}

Truth::Truth(const StressFrame& frame, Scene scene)
    : frame_(frame),
      scene_(as_known(std::move(scene), knows(frame.options.volumetrics.technique))),
      media_(scene_.media),
      local_(local_of(scene_.media)),
      smooth_(without_noise(local_of(scene_.media))) {
    const auto& chosen = frame.options.volumetrics;
    reference::Settings settings{.light_transmittance = chosen.light.transmittance,
                                 .phase = {.kind = static_cast<reference::ParticlePhase::Kind>(chosen.light.phase),
                                           .back_anisotropy = chosen.light.back_anisotropy,
                                           .back_weight = chosen.light.back_weight,
                                           .droplet_diameter = chosen.light.droplet_diameter},
                                 .shadows = false,
                                 .ambient = frame.options.render.ambient,
                                 .black_surfaces = true,
                                 .black_sky = true,
                                 .tolerance = 1e-4};
    open_ = std::make_unique<reference::Reference>(scene_, settings);
    if (!frame.options.render.shadows || !knows(frame.options.volumetrics.technique).shadow_maps ||
        !casts_shadows(scene_))
        return;
    settings.shadows = true;
    shadowed_ = std::make_unique<reference::Reference>(scene_, settings);
}

bool Truth::is_homogeneous() const {
    return std::ranges::all_of(scene_.media, [](const Medium& m) { return m.shape == Medium::Shape::global; });
}

// In a homogeneous medium light is source / sigma_t (1 - T), whatever T.
void Truth::apply_fog_mode(reference::Reference::Ray& ray) const {
    const volumetrics::Settings& v = frame_.options.volumetrics;
    using enum volumetrics::FogMode;
    if (frame_.options.volumetrics.technique != "analytic_fog" || v.analytic_fog.mode == height) return;
    const dvec3 sigma_t = media_.at(dvec3(frame_.view.eye)).sigma_t;
    for (int c = 0; c < 3; ++c) {
        if (sigma_t[c] == 0) continue;
        const double x = sigma_t[c] * ray.distance, half = std::numbers::ln2;
        const double t = v.analytic_fog.mode == linear    ? std::max(1 - x / (2 * half), 0.0)
                         : v.analytic_fog.mode == squared ? std::exp(-x * x / half)
                                                          : std::exp(-x);
        ray.scattering[c] *= (1 - t) / (1 - ray.transmittance[c]);
        ray.transmittance[c] = t;
    }
}

Truth::Pixel Truth::trace(glm::ivec2 place) const {
    Pixel pixel{place, pixel_ray(frame_.view, frame_.size, place), {}};
    pixel.open = open_->trace(pixel.ray.origin, pixel.ray.direction, pixel.ray.begin);
    pixel.open.scattering /= scene_.light_unit();
    apply_fog_mode(pixel.open);
    return pixel;
}

dvec3 Truth::transmittance(glm::ivec2 place) const {
    const PixelRay ray = pixel_ray(frame_.view, frame_.size, place);
    return glm::exp(-media_.optical_depth(ray.origin, ray.direction, 0, visible_distance(ray), true, 1e-3));
}

double Truth::visible_distance(const PixelRay& ray) const {
    return open_->visible_distance(ray.origin, ray.direction, ray.begin);
}

dvec3 Truth::shadowed(const PixelRay& ray) const {
    return shadowed_->trace(ray.origin, ray.direction, ray.begin).scattering / double(scene_.light_unit());
}

}  // namespace tyndall::stress
