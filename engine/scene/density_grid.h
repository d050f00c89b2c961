#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace tyndall {

/// Sparse voxels of a density, as of a .vdb, .nvdb or volume texture file. A voxel's centre lies at whole
/// coordinates; where there is no brick the density is 0, and so are a file's inactive voxels, whatever it stores.
struct DensityGrid {
    static constexpr int side = 8;  ///< voxels of a brick
    static constexpr int brick_size = side * side * side;

    std::vector<glm::ivec3> bricks;  ///< lowest voxel of each: multiples of `side`; no two alike; some voxel > 0
    std::vector<float> values;       ///< brick_size of each, x fastest, then y, then z; finite, not negative
    glm::dmat4 index_to_grid{1};     ///< affine, invertible: voxel coordinates to the file's space, m
    glm::ivec3 lower{0}, upper{-1};  ///< of the voxels > 0, both included
    float greatest = 0;              ///< value; 0: the grid is empty

    [[nodiscard]] bool empty() const { return bricks.empty(); }
};

/// Reads .vdb, .nvdb, or a volume texture's .json (volume_texture.h). `name` picks the grid of the file; a texture
/// has only one. OpenVDB and NanoVDB read in a child process, for 10 s at most. Throws Error of one line that
/// starts with the path: files that are missing, truncated, corrupt, of another kind (level sets, vectors, double
/// precision), without such a grid, too large, too slow to read, with values that are negative, not finite or
/// beyond 1e6.
[[nodiscard]] std::shared_ptr<const DensityGrid> load_density_grid(const std::filesystem::path& file,
                                                                   const std::string& name);

}  // namespace tyndall
