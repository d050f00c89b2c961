#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tyndall::grid_models {

/// A dense box of densities.
struct Voxels {
    glm::ivec3 size{0};
    float voxel_size = 1;       ///< m
    glm::vec3 first_voxel{0};   ///< where the centre of voxel (0, 0, 0) lies, m
    std::vector<float> values;  ///< x fastest, then y, then z

    Voxels(glm::ivec3 size_, float voxel_size_, glm::vec3 first_voxel_)
        : size(size_),
          voxel_size(voxel_size_),
          first_voxel(first_voxel_),
          values(std::size_t(size_.x) * size_.y * size_.z) {}

    [[nodiscard]] float& at(int x, int y, int z) { return values[index(x, y, z)]; }
    [[nodiscard]] float at(int x, int y, int z) const { return values[index(x, y, z)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (std::size_t(z) * size.y + y) * size.x + x;
    }
};

}  // namespace tyndall::grid_models
