#include "engine/render/lamps.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

glm::mat4 world_of(const Scene& scene, std::size_t light) {
    return node_pose(scene, scene.lights[light].node);
}

}  // namespace

glm::vec3 sun_position(const glm::mat4& world) {
    return sun_distance * glm::normalize(glm::vec3(world[2]));
}

std::vector<Lamp> find_lamps(const Scene& scene, const Frustum& frustum) {
    std::vector<Lamp> lamps;
    std::vector<std::size_t> suns = scene.suns();
    if (!suns.empty()) suns.erase(suns.begin());
    std::ranges::sort(suns);
    for (const std::size_t sun : suns) {
        const glm::mat4 world = world_of(scene, sun);
        lamps.push_back({.light = sun,
                         .position = sun_position(world),
                         .range = sun_range,
                         .axis = -glm::normalize(glm::vec3(world[2])),
                         .in_view = true});
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.type == LightType::sun || light.node < 0 || light.intensity == glm::vec3(0)) continue;
        const glm::mat4 world = world_of(scene, i);
        const glm::vec3 position(world[3]);
        lamps.push_back({.light = i,
                         .position = position,
                         .range = light.range,
                         .axis = -glm::vec3(world[2]),
                         .cos_outer = light.type == LightType::spot ? std::cos(light.outer_cone) : -1.0f,
                         .in_view = frustum.intersects_sphere(position, light.range)});
    }
    return lamps;
}

}  // namespace tyndall
