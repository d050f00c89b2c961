#include "engine/render/glass.h"

#include <algorithm>
#include <vector>

namespace tyndall {
namespace {

bool meets_sphere(const Aabb& box, glm::vec3 center, float radius) {
    const glm::vec3 offset = center - glm::clamp(center, box.min, box.max);
    return glm::dot(offset, offset) <= radius * radius;
}

}  // namespace

// The box with all that lies behind it is convex: it is outside of a plane if the box is and light does not come
// nearer.
bool shades(const Aabb& box, glm::vec3 direction, const Frustum& view) {
    const glm::vec3 center = 0.5f * (box.min + box.max), extent = 0.5f * (box.max - box.min);
    for (int i = 0; i < view.count; ++i) {
        const glm::vec4& plane = view.planes[static_cast<std::size_t>(i)];
        const glm::vec3 normal(plane);
        if (glm::dot(normal, direction) <= 0 &&
            glm::dot(normal, center) + glm::dot(glm::abs(normal), extent) + plane.w < 0)
            return false;
    }
    return true;
}

void find_glass(const Scene& scene, const GpuScene& gpu, const View& view, FrameFacts& facts) {
    std::vector<const Instance*> glass;
    for (const Instance& instance : gpu.instances())
        if (instance.cast_shadow && gpu.material(instance.material).alpha_blend) glass.push_back(&instance);
    const Frustum frustum = Frustum::from(view.view_projection);
    const auto before_sun = [&](std::size_t light) {
        const Light& sun = scene.lights[light];
        if (!sun.shadow || sun.node < 0) return false;
        const glm::vec3 direction = -glm::vec3(node_pose(scene, sun.node)[2]);
        return std::ranges::any_of(glass, [&](const Instance* g) { return shades(g->bounds, direction, frustum); });
    };
    facts.sun_through_glass = facts.has_sun && before_sun(*scene.sun());
    for (Lamp& lamp : facts.lamps) {
        if (!lamp.in_view || !scene.lights[lamp.light].shadow) continue;
        lamp.through_glass = scene.lights[lamp.light].type == LightType::sun
                                 ? before_sun(lamp.light)
                                 : std::ranges::any_of(glass, [&](const Instance* g) {
                                       return meets_sphere(g->bounds, lamp.position, lamp.range);
                                   });
    }
}

}  // namespace tyndall
