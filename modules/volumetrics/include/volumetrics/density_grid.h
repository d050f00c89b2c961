#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

namespace tyndall::volumetrics {

struct LocalMedium;

/// Sparse voxels of a density. A voxel's centre lies at whole coordinates; without a brick the density is 0.
struct DensityGrid {
    static constexpr int side = 8;  ///< voxels of a brick
    static constexpr int brick_size = side * side * side;

    std::span<const glm::ivec3> bricks;  ///< lowest voxel of each: multiples of `side`, no two alike
    std::span<const float> values;       ///< brick_size of each, x fastest, then y, z; finite, not negative
    std::shared_ptr<const void> owner;   ///< of both; they never change
    glm::ivec3 lower{0}, upper{-1};      ///< of the voxels > 0, both included
    float greatest = 0;                  ///< value
    double sum = 0;                      ///< of all values
    std::uint32_t number = 0;            ///< no other grid has it
};

/// Finds bounds, greatest value and sum. Throws Error where the spans do not fit each other or hold what they must
/// not.
[[nodiscard]] std::shared_ptr<const DensityGrid> density_grid(std::span<const glm::ivec3> bricks,
                                                              std::span<const float> values,
                                                              std::shared_ptr<const void> owner);

/// Makes a grid the medium's shape and places it: center, half_extent, rotation and world_to_voxel. The density is
/// the voxels' times 1: coefficients are those at value 1. `voxel_to_world` is affine and invertible. `nearest`: a
/// voxel's value fills its cube; else the density is trilinear between voxel centres. Equal pointers are equal
/// contents: media may share one grid.
void set_grid(LocalMedium& medium, std::shared_ptr<const DensityGrid> grid, const glm::dmat4& voxel_to_world,
              bool nearest = false);

}  // namespace tyndall::volumetrics
