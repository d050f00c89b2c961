#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "media/froxel_grid.h"
#include "media/media.h"

namespace tyndall::volumetrics {

[[nodiscard]] ViewBounds view_bounds(const std::array<glm::vec3, 8>& corners, const Inputs& inputs);
[[nodiscard]] ViewBounds view_bounds(const LocalMedium& medium, const Inputs& inputs);
/// For each column of froxels, along x first: nearest and farthest view depth [m] of Inputs::transparents that may
/// be seen in it or beside it; {infinity, 0}: of none.
[[nodiscard]] std::vector<glm::vec2> transparent_depths(const Inputs& inputs, glm::ivec2 columns);

/// Something in view may lie in the medium or behind it, seen from a light.
[[nodiscard]] bool may_matter(const LocalMedium& medium, const Inputs& inputs);
/// The froxels that a medium may touch, never too few; empty where they do not reach it.
[[nodiscard]] IndexBox froxel_bounds(const ViewBounds& bounds, const FroxelGrid& grid);

/// For each tile of SCREEN_MEDIA_X × SCREEN_MEDIA_Y of the screen, from the lower left on and along x first, a bit
/// for each medium that may be seen in it, in (bounds.size() + 31) / 32 words.
[[nodiscard]] std::vector<std::uint32_t> screen_media(std::span<const ViewBounds> bounds);

/// Froxels of one tile: one work group of shaders/volumetrics/media/inject_media.comp.
constexpr glm::ivec3 froxel_tile{16, 16, 1};
/// The tiles that some box meets, in the order z, y, x: for each, x | y << 10 | z << 20 and then
/// (boxes.size() + 31) / 32 words, in which bit i says that box i meets the tile.
[[nodiscard]] std::vector<std::uint32_t> live_tiles(std::span<const IndexBox> boxes, glm::ivec3 froxels);

}  // namespace tyndall::volumetrics
