#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "shaders/shared/lights.h"

namespace tyndall {

/// A point or spot lamp that shines, where its node stands now; or a further sun: beside the brightest one, suns
/// are lamps so far away that their light is parallel, and of an intensity that leaves their illuminance here.
struct Lamp {
    std::size_t light = 0;       ///< of Scene::lights
    glm::vec3 position{0};       ///< m
    float range = 0;             ///< m
    glm::vec3 axis{0, 0, -1};    ///< unit, the way it points
    float cos_outer = -1;        ///< of its cone's half angle; -1: a point lamp
    bool in_view = false;        ///< its sphere of influence meets the view frustum
    bool through_glass = false;  ///< find_glass(): some may stand before what it lights
};

constexpr float sun_distance = SUN_LAMP_DISTANCE;  ///< m from the origin, of a further sun
constexpr float sun_range = 1e3f * sun_distance;   ///< m: its window takes 1e-12 of the light

/// Where a further sun with that node stands.
[[nodiscard]] glm::vec3 sun_position(const glm::mat4& world);

/// All of a scene: further suns, then lamps, each in the scene's order, which is that of the lights in shaders too.
[[nodiscard]] std::vector<Lamp> find_lamps(const Scene& scene, const Frustum& frustum);

}  // namespace tyndall
