#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/density_grid.h"
#include "reference/density_line.h"
#include "reference/geometry.h"

namespace tyndall::reference {

/// The density of a grid's voxels everywhere, in voxel coordinates: trilinear between voxel centres, or that of the
/// voxel floor(p + 1/2). Rays o + t d count distance in whatever unit d does. Thread-safe.
///
/// Space is divided into unit cells on which the density has one formula: the cube between 8 voxel centres, where
/// the density along a line is a cubic polynomial of t, or a voxel's own cube, where it is constant. 8^3 cells are
/// a block with all voxels that they need; a ray walks from block to block, and inside of one that is not empty
/// from cell to cell.
class DensityField {
  public:
    DensityField(const DensityGrid& grid, bool nearest);

    /// The smallest box outside of which the density is 0.
    [[nodiscard]] dvec3 lower() const { return lower_; }
    [[nodiscard]] dvec3 upper() const { return upper_; }

    [[nodiscard]] double at(dvec3 point) const;
    /// Of the density over [begin, end], which may be infinite. Exact but for rounding.
    [[nodiscard]] double integral(dvec3 origin, dvec3 direction, Interval part) const;
    /// `factor` times the density, and its integral as a function of where it ends.
    [[nodiscard]] DensityLine line(dvec3 origin, dvec3 direction, Interval part, double factor) const;

  private:
    static constexpr int side = DensityGrid::side;

    /// Numbers of blocks in a box, -1 where there is none. Coordinates in blocks.
    struct Table {
        glm::ivec3 lower{0}, size{0};
        std::vector<std::int32_t> numbers;
        Table() = default;
        Table(glm::ivec3 lower, glm::ivec3 upper);
        [[nodiscard]] std::size_t index(glm::ivec3 block) const;
        [[nodiscard]] std::int32_t find(glm::ivec3 block) const;
    };
    struct Block {
        std::array<std::uint64_t, side> occupied{};  ///< cells that are not empty: bit 8 y + x of number z
        std::vector<float> values;
        [[nodiscard]] bool has(glm::ivec3 cell) const {
            return (occupied[static_cast<std::size_t>(cell.z)] >> (side * cell.y + cell.x) & 1) != 0;
        }
    };
    struct Planes;

    void add_block(glm::ivec3 block, const DensityGrid& grid, const Table& bricks);
    /// The voxel at the lowest corner of a cell.
    [[nodiscard]] const float* corner(const Block& block, glm::ivec3 cell) const {
        return block.values.data() + (cell.x + stride_ * (cell.y + stride_ * cell.z));
    }
    template <class Visit>
    void walk(dvec3 origin, dvec3 direction, Interval part, Visit visit) const;
    template <class Visit>
    void walk_block(const Planes& planes, Interval part, glm::ivec3 at, Visit& visit) const;

    bool nearest_;
    int stride_;  ///< voxels of a block along an edge: those of its cells, and the next ones where it is trilinear
    dvec3 offset_;  ///< from voxel coordinates to cells': a cell is [i, i + 1)^3 of those
    dvec3 lower_{0}, upper_{0};
    Table table_;
    std::vector<Block> blocks_;
};

}  // namespace tyndall::reference
