#include "engine/render/lamps.h"

#include <cmath>

namespace tyndall {

std::vector<Lamp> find_lamps(const Scene& scene, const Frustum& frustum) {
    std::vector<Lamp> lamps;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.type == LightType::sun || light.node < 0 || light.intensity == glm::vec3(0)) continue;
        const glm::mat4& world = scene.nodes[static_cast<std::size_t>(light.node)].world;
        const glm::vec3 position(world[3]);
        lamps.push_back({.light = i,
                         .position = position,
                         .range = light.range,
                         .axis = -glm::normalize(glm::vec3(world[2])),
                         .cos_outer = light.type == LightType::spot ? std::cos(light.outer_cone) : -1.0f,
                         .in_view = frustum.intersects_sphere(position, light.range)});
    }
    return lamps;
}

}  // namespace tyndall
