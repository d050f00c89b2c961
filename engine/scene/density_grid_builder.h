#pragma once

#include <optional>
#include <vector>

#include "engine/grids/grid_sink.h"
#include "engine/scene/density_grid.h"

namespace tyndall {

/// Puts a grid together from what a reader sends, and trusts none of it. Throws Error of one line without the path.
class DensityGridBuilder final : public grids::GridSink {
  public:
    static constexpr std::size_t most_bricks = (std::size_t{1} << 26U) / DensityGrid::brick_size;
    static constexpr int longest_side = 1 << 15;  ///< voxels of the box round those above 0
    static constexpr int farthest = 1 << 23;      ///< voxel coordinates: exact in float
    static constexpr float greatest = 1e6F;

    void transform(const glm::dmat4& index_to_grid) override;
    void brick(const glm::ivec3& lower, const grids::BrickValues& values) override;
    void tile(const glm::ivec3& lower, int side, float value) override;

    /// The grid, when all is told.
    [[nodiscard]] DensityGrid finish();

  private:
    void require_room(std::size_t bricks) const;
    void require_distinct_bricks() const;
    void measure();

    DensityGrid grid_;
    std::optional<glm::dmat4> transform_;
};

}  // namespace tyndall
