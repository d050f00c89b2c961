#pragma once

#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

/// A grid's too. See shape.cpp and shaders/volumetrics/media/shape_box.glsl.
struct BoxShape {
    static_assert(static_cast<int>(Shape::box) == SHAPE_BOX && static_cast<int>(Shape::grid) == SHAPE_GRID);

    template <class T>
    static T half_extent_along(glm::vec<3, T> half_size, glm::vec<3, T> direction) {
        const glm::vec<3, T> reach = glm::abs(direction * half_size);
        return reach.x + reach.y + reach.z;
    }
    static float bounding_radius(glm::vec3 half_size) { return glm::length(half_size); }
    static float volume(glm::vec3 half_size) { return half_size.x * half_size.y * half_size.z * 8; }
};

}  // namespace tyndall::volumetrics
