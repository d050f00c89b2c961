#pragma once

#include "support/world.h"

namespace tyndall::reference::test {

/// A transparent material.
struct Glass {
    glm::vec4 color;
    float transmission;

    /// What it leaves of light.
    [[nodiscard]] dvec3 filter() const {
        return (1 - double{color.a}) + double{color.a} * double{transmission} * dvec3(glm::vec3(color));
    }
    /// A mesh of it.
    [[nodiscard]] Mesh& mesh(World& w) const {
        Material& m = w.scene.materials.emplace_back();
        m.alpha_blend = true;
        m.base_color = color;
        m.transmission = transmission;
        return w.mesh(static_cast<int>(w.scene.materials.size()) - 1);
    }
};
inline const Glass red{{1, 0.5f, 0.25f, 0.5f}, 0.75f}, blue{{0.125f, 0.25f, 1, 1}, 0.5f},
    grey{{0.5f, 1, 1, 0.25f}, 0}, clear{{0.1f, 0.2f, 0.3f, 0}, 0.5f}, black{{0.1f, 0.2f, 0.3f, 1}, 0};

}  // namespace tyndall::reference::test
