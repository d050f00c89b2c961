#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/render/atlas_allocator.h"
#include "engine/scene/scene.h"
#include "shaders/shared/lights.h"

namespace tyndall {

inline constexpr int smallest_shadow_tile = 16;  ///< px

/// Tiles a light's shadow takes: 6 faces of a cube for a point light, 1 for a spot or a further sun.
[[nodiscard]] int shadow_tile_count(LightType type);

/// log2 of the tile side at which the tile's texels look as large as one another from everywhere: `size_max` where
/// the eye is one range away, half of it at twice the distance, and so on (not clamped: greater means more
/// important). Rounded; `previous` (or -1) is kept until the exact value is 0.75 away from it, so that a light near
/// a boundary does not change with every step. Range and distance in m.
[[nodiscard]] int shadow_tile_level(float range, float distance, int size_max, int previous);

struct TileDemand {
    int level = 0;  ///< from shadow_tile_level
    int tiles = 1;
};
/// Sides (px) of the tiles of each demand, in the same order, so that all fit an atlas of `area` px². Sizes are
/// 2^level within smallest_shadow_tile..size_max; where that is too much all are halved until they fit, and the
/// most important get one size back while there is room. 0 (no tile) is the last resort, least important first.
[[nodiscard]] std::vector<int> plan_tile_sizes(std::span<const TileDemand> demands, int size_max, long long area);

/// The map of a spot (face 0) or one face of a point light (+X -X +Y -Y +Z -Z), in the tile's place. The depth
/// range is max(radius, 0.02 m) to the light's range: what is nearer casts no shadow (a lamp's own bulb). The image
/// is wider than the cone or the face by SHADOW_TILE_BORDER texels, so that a filter at its rim reads drawn texels
/// of this tile: that makes the seams of a cube disappear. Half angles beyond 80° are drawn to 80°, the rim's
/// shadow is used outside.
[[nodiscard]] shared::ShadowTile make_shadow_tile(const Light& light, const glm::mat4& pose, int face,
                                                  const AtlasTile& place, int atlas_size);

/// The map of a further sun: `bounds`, and all that lies between them and the sun.
[[nodiscard]] shared::ShadowTile make_sun_tile(const Aabb& bounds, const glm::mat4& light_to_world,
                                               const AtlasTile& place, int atlas_size);

}  // namespace tyndall
