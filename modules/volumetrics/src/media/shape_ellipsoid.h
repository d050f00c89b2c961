#pragma once

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

/// See shape.cpp and shaders/volumetrics/media/shape_ellipsoid.glsl.
struct EllipsoidShape {
    static_assert(static_cast<int>(Shape::ellipsoid) == SHAPE_ELLIPSOID);

    template <class T>
    static T half_extent_along(glm::vec<3, T> radii, glm::vec<3, T> direction) {
        return glm::length(direction * radii);
    }
    static float bounding_radius(glm::vec3 radii) { return std::max({radii.x, radii.y, radii.z}); }
    static float volume(glm::vec3 radii) { return radii.x * radii.y * radii.z * (4.0F / 3.0F * glm::pi<float>()); }
};

}  // namespace tyndall::volumetrics
