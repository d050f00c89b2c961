#include "engine/render/light_set.h"

#include <cmath>

#include "engine/core/check.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/bindings.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/light_reach.glsl"
#include "shaders/lib/lamp_segment.glsl"
TYNDALL_GLSL_END

namespace tyndall {

shared::GpuLight gpu_light(const Light& light, const glm::mat4& pose, int first_tile) {
    if (light.type == LightType::sun)
        return {.position_range = {sun_position(pose), sun_range},
                .intensity_radius = {light.intensity * (sun_distance * sun_distance), light.radius},
                .direction_type = {-glm::vec3(pose[2]), static_cast<float>(LIGHT_SUN)},
                .cone_shadow = {0, 1, static_cast<float>(first_tile), 0}};
    TYNDALL_CHECK_LT(0.0f, light.range);
    const bool spot = light.type == LightType::spot;
    const glm::vec2 cone =
        spot ? glsl::spot_scale_offset(std::cos(light.inner_cone), std::cos(light.outer_cone)) : glm::vec2(0, 1);
    return {.position_range = {glm::vec3(pose[3]), light.range},
            .intensity_radius = {light.intensity, light.radius},
            .direction_type = {-glm::vec3(pose[2]), static_cast<float>(spot ? LIGHT_SPOT : LIGHT_POINT)},
            .cone_shadow = {cone, static_cast<float>(first_tile), 0}};
}

glm::vec4 reach(const shared::GpuLight& light) {
    const glm::vec3 position(light.position_range), axis(light.direction_type);
    const float range = light.position_range.w;
    if (light.direction_type.w != static_cast<float>(LIGHT_SPOT)) return {position, range};
    return glsl::cone_reach(position, axis, range, glsl::cone_cosine(glm::vec2(light.cone_shadow)));
}

void LightSet::update(const Scene& scene, std::span<const Lamp> lamps) {
    lights_.clear();
    scene_index_.clear();
    for (const Lamp& lamp : lamps) {
        const Light& light = scene.lights[lamp.light];
        lights_.push_back(gpu_light(light, node_pose(scene, light.node), -1));
        lights_.back().cone_shadow.w = lamp.through_glass ? 1.0f : 0.0f;
        lights_.back().intensity_radius *= glm::vec4(glm::vec3(1 / scene.light_unit()), 1);
        scene_index_.push_back(lamp.light);
    }
}

void LightSet::set_shadow_tiles(const std::function<int(std::size_t)>& first_tile) {
    for (std::size_t i = 0; i < lights_.size(); ++i)
        lights_[i].cone_shadow.z = static_cast<float>(first_tile(scene_index_[i]));
}

void LightSet::upload() {
    buffer_.assign(std::span<const shared::GpuLight>(lights_), "lights");
}

void LightSet::bind() const {
    buffer_.bind(IMAGE_LIGHTS);
}

}  // namespace tyndall
