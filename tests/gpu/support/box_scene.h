#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/scene/scene.h"

namespace tyndall {

/// An axis-aligned box in world space. It is all a test scene is made of, so that visibility has a closed form.
struct TestBox {
    glm::vec3 min, max;
    bool dynamic = false;
};

/// One node and mesh per box, in order; box i is node i. World transforms and bounds are up to date.
[[nodiscard]] Scene box_scene(std::span<const TestBox> boxes);
/// Appends a node with a light that shines from `position` along `direction`; returns the light's index.
std::size_t add_light(Scene& scene, Light light, glm::vec3 position, glm::vec3 direction);

/// Whether the open segment from `a` to `b` meets a box (slab test in double precision).
[[nodiscard]] bool blocked(std::span<const TestBox> boxes, glm::dvec3 a, glm::dvec3 b);

}  // namespace tyndall
