#include "engine/render/frame_facts.h"

#include <algorithm>

#include "shaders/shared/lights.h"

namespace tyndall {
namespace {

bool is_dark(glm::vec3 v) {
    return v.x <= 0 && v.y <= 0 && v.z <= 0;
}

void add_lights(FrameFacts& facts, const Scene& scene, const Frustum& frustum) {
    facts.has_sun = scene.sun().has_value();
    facts.lamps = find_lamps(scene, frustum);
    facts.local_lights_in_view = static_cast<int>(std::ranges::count(facts.lamps, true, &Lamp::in_view));
}

void add_media(FrameFacts& facts, const Scene& scene, const Frustum& frustum) {
    for (const Medium& medium : scene.media) {
        if (is_dark(medium.sigma_s + medium.sigma_a) && is_dark(medium.emission)) continue;
        if (!is_bounded(medium))
            facts.has_global_medium = true;
        else if (frustum.intersects(world_bounds(medium)))
            facts.has_local_media = true;
    }
}

}  // namespace

int FrameFacts::glass() const {
    return (sun_through_glass ? GLASS_SUN : 0) |
           (std::ranges::any_of(lamps, &Lamp::through_glass) ? GLASS_LAMPS : 0);
}

FrameFacts compute_facts(const Scene& scene, const View& view) {
    FrameFacts facts;
    facts.has_ambient = true;  // the procedural sky is always there
    const Frustum frustum = Frustum::from(view.view_projection);
    add_lights(facts, scene, frustum);
    add_media(facts, scene, frustum);
    return facts;
}

}  // namespace tyndall
