#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/view.h"

namespace tyndall {

/// A point or spot lamp that shines, where its node stands now.
struct Lamp {
    std::size_t light = 0;     ///< of Scene::lights
    glm::vec3 position{0};     ///< m
    float range = 0;           ///< m
    glm::vec3 axis{0, 0, -1};  ///< unit, the way it points
    float cos_outer = -1;      ///< of its cone's half angle; -1: a point lamp
    bool in_view = false;      ///< its sphere of influence meets the view frustum
};

/// All of a scene, in its order, which is that of the lights in shaders too.
[[nodiscard]] std::vector<Lamp> find_lamps(const Scene& scene, const Frustum& frustum);

}  // namespace tyndall
