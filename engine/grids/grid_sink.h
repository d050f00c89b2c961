#pragma once

#include <array>
#include <glm/glm.hpp>
#include <stdexcept>

namespace tyndall::grids {

constexpr int brick_side = 8;

using BrickValues = std::array<float, brick_side * brick_side * brick_side>;  ///< x fastest, then y, then z

/// What a reader finds in a file. It tells active voxels only: inactive ones are 0.
class GridSink {
  public:
    virtual ~GridSink() = default;
    virtual void transform(const glm::dmat4& index_to_grid) = 0;
    /// `lower`: the lowest voxel.
    virtual void brick(const glm::ivec3& lower, const BrickValues& values) = 0;
    /// A cube of one value: `side` is 8, 128 or 4096 voxels.
    virtual void tile(const glm::ivec3& lower, int side, float value) = 0;
};

/// A file that cannot be a density; the text goes after the file's path.
struct Unreadable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace tyndall::grids
