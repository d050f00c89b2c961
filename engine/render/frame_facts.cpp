#include "engine/render/frame_facts.h"

#include <algorithm>

namespace tyndall {
namespace {

bool is_dark(glm::vec3 v) {
    return v.x <= 0 && v.y <= 0 && v.z <= 0;
}

bool contains(const Medium& medium, glm::vec3 point) {
    const glm::vec3 p = glm::inverse(medium.rotation) * (point - medium.center) / medium.half_extent;
    if (medium.shape == Medium::Shape::box) return glm::all(glm::lessThanEqual(glm::abs(p), glm::vec3(1)));
    return glm::dot(p, p) <= 1;
}

void add_lights(FrameFacts& facts, const Scene& scene, const Frustum& frustum) {
    const auto sun = scene.sun();
    facts.has_sun = sun && !is_dark(scene.lights[*sun].intensity);
    for (const Light& light : scene.lights) {
        if (light.type == LightType::sun || is_dark(light.intensity)) continue;
        const glm::vec3 position(scene.nodes[static_cast<std::size_t>(light.node)].world[3]);
        if (!frustum.intersects_sphere(position, light.range)) continue;
        ++facts.local_lights_in_view;
        facts.has_shadowed_lights |= light.shadow;
    }
}

void add_media(FrameFacts& facts, const Scene& scene, const Frustum& frustum, glm::vec3 eye) {
    for (const Medium& medium : scene.media) {
        const glm::vec3 sigma_t = medium.sigma_s + medium.sigma_a;
        if (is_dark(sigma_t) && is_dark(medium.emission)) continue;
        const bool bounded = is_bounded(medium);
        if (bounded && !frustum.intersects(world_bounds(medium))) continue;
        (bounded ? facts.has_local_media : facts.has_global_medium) = true;
        facts.camera_inside_medium |= !bounded || contains(medium, eye);
        facts.has_emissive_media |= !is_dark(medium.emission);
        facts.max_extinction = std::max({facts.max_extinction, sigma_t.x, sigma_t.y, sigma_t.z});
    }
}

}  // namespace

FrameFacts compute_facts(const Scene& scene, const View& view) {
    FrameFacts facts;
    facts.has_ambient = true;  // the procedural sky is always there
    const Frustum frustum = Frustum::from(view.view_projection);
    add_lights(facts, scene, frustum);
    add_media(facts, scene, frustum, view.eye);
    return facts;
}

}  // namespace tyndall
