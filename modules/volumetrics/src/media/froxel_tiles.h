#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "media/froxel_grid.h"
#include "media/media.h"

namespace tyndall::volumetrics {

/// Of a medium's corners: view depths [m] and bounds on the screen (0..1); the whole screen where it reaches behind
/// the eye.
struct ViewBounds {
    float nearest = std::numeric_limits<float>::max(), farthest = std::numeric_limits<float>::lowest();
    glm::vec2 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
};
[[nodiscard]] ViewBounds view_bounds(const LocalMedium& medium, const Inputs& inputs);

/// The froxels whose centres a medium may cover, never too few; empty when it is out of view.
[[nodiscard]] IndexBox froxel_bounds(const LocalMedium& medium, const Inputs& inputs, const FroxelGrid& grid);

/// Nearest and farthest view depth [m] of the slices that the boxes take up.
[[nodiscard]] glm::vec2 view_depths(std::span<const IndexBox> boxes, const FroxelGrid& grid);

/// Froxels of one tile: one work group of shaders/volumetrics/media/inject_media.comp.
constexpr glm::ivec3 froxel_tile{16, 16, 1};
/// The tiles that some box meets, in the order z, y, x: for each, x | y << 10 | z << 20 and then
/// (boxes.size() + 31) / 32 words, in which bit i says that box i meets the tile.
[[nodiscard]] std::vector<std::uint32_t> live_tiles(std::span<const IndexBox> boxes, glm::ivec3 froxels);

}  // namespace tyndall::volumetrics
