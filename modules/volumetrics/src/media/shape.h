#pragma once

#include <array>

#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

// What is asked of a local medium's shape: each has a file that answers (shape_box.h …) and a row in shape.cpp. The
// shaders' part is shaders/volumetrics/media/shape.glsl. Lengths in m; directions are unit vectors of the world.

/// No extent, or none that makes sense: it holds no point, and dividing by it would give NaN.
[[nodiscard]] bool is_empty(const LocalMedium& medium);
/// Of the box round it, turned as it is.
[[nodiscard]] std::array<glm::vec3, 8> corners(const LocalMedium& medium);
/// Nearest and farthest distance from a point to that box.
[[nodiscard]] glm::vec2 distances(const LocalMedium& medium, glm::vec3 point);
/// Of the smallest sphere round its centre that holds it.
[[nodiscard]] float bounding_radius(const LocalMedium& medium);
/// Half of what it covers along a direction.
[[nodiscard]] double half_extent_along(const LocalMedium& medium, glm::dvec3 direction);

/// Shape, place, extent and softness; the rest 0.
[[nodiscard]] shared::LocalMedium pack_shape(const LocalMedium& medium);
[[nodiscard]] float half_extent_along(const shared::LocalMedium& medium, glm::vec3 direction);
[[nodiscard]] float volume(const shared::LocalMedium& medium);

}  // namespace tyndall::volumetrics
