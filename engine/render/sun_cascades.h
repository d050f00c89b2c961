#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "shaders/shared/frame.h"

namespace tyndall {

/// An orthographic shadow map of the sun. `world_to_texture` gives uv and depth, all 0..1 inside the map; depth is
/// reversed: 1 at the side of the sun.
struct SunMap {
    glm::mat4 world_to_texture{1};
    float texel = 0;  ///< m, side of one texel
};

/// View depths (m) where the cascades end, rising, the last one `far`. The practical split scheme (Zhang et al.,
/// "Parallel-split shadow maps", 2006): end_i = λ n (f/n)^(i/N) + (1 - λ)(n + (f - n) i/N), λ = `lambda` in 0..1:
/// 0 uniform, 1 logarithmic. Needs 0 < near < far.
[[nodiscard]] std::array<float, SUN_CASCADES> cascade_ends(float near, float far, float lambda);

/// Rows: right, up, towards the sun; a rotation that depends on nothing but the direction sunlight travels.
[[nodiscard]] glm::mat3 sun_basis(glm::vec3 sun_direction);

/// Smallest sphere round the part of a symmetric view frustum between two view depths (m): `center` is its distance
/// in front of the eye. It depends on the lens only, so it keeps its size when the camera moves or turns.
struct SliceSphere {
    float center, radius;
};
[[nodiscard]] SliceSphere slice_sphere(float yfov, float aspect, float begin, float end);

/// Side (px) of the map of a cascade of `size` px, which has a sixteenth more for its part of the view to move in.
[[nodiscard]] constexpr int cascade_map_size(int size) {
    return size + size / 16;
}

/// The map of one cascade: the slice's sphere over `size` px with a rim for the filter, its centre moved to the
/// nearest point of a grid that is fixed in the world and a sixteenth of them wide. So texels stay where they are,
/// and the map the same, and need not be drawn again, until the camera has moved the sphere so far. Casters nearer
/// to the sun than the map must be drawn with depth clamp.
[[nodiscard]] SunMap fit_cascade(const View& view, float begin, float end, glm::vec3 sun_direction, int size);

/// The map of everything: `bounds` seen from the sun. Empty bounds give a map of the unit box at the origin.
[[nodiscard]] SunMap fit_static(const Aabb& bounds, glm::vec3 sun_direction, int map_size);

[[nodiscard]] glm::mat4 world_to_clip(const SunMap& map);

/// Where a caster must be to matter to the map: inside its sides, and at any distance towards the sun.
[[nodiscard]] Frustum caster_volume(const SunMap& map);

}  // namespace tyndall
