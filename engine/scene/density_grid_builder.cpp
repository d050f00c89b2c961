#include "engine/scene/density_grid_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"

namespace tyndall {
namespace {

static_assert(grids::brick_side == DensityGrid::side);

void require_density(float value) {
    if (!std::isfinite(value) || value < 0 || value > DensityGridBuilder::greatest)
        throw Error(
            fmt::format("a voxel is {}, values from 0 to {:g} expected", value, DensityGridBuilder::greatest));
}

void require_place(const glm::ivec3& lower, int side) {
    for (int axis = 0; axis < 3; ++axis) {
        if (lower[axis] % DensityGrid::side != 0) throw Error("damaged: a brick lies off the bricks' lattice");
        if (std::abs(std::int64_t{lower[axis]}) > DensityGridBuilder::farthest - side)
            throw Error(fmt::format("too large: a voxel at {}, at most {} expected", lower[axis],
                                    DensityGridBuilder::farthest));
    }
}

/// Voxels of a size, in m, that later squares and inverses can bear, and not nearly flat.
void require_invertible(const glm::dmat4& m) {
    const auto reject = [](std::string_view why) { throw Error(fmt::format("its transform {}", why)); };
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) reject("is not finite");
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) reject("is not affine");
    double box = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = glm::length(glm::dvec3(m[axis]));
        if (!(edge >= 1e-6 && edge <= 1e9)) reject(fmt::format("has voxels of {:g} m, 1e-6 to 1e9 expected", edge));
        box *= edge;
    }
    if (!(std::abs(glm::determinant(glm::dmat3(m))) >= 1e-6 * box)) reject("has no inverse");
}

}  // namespace

void DensityGridBuilder::transform(const glm::dmat4& index_to_grid) {
    require_invertible(index_to_grid);
    transform_ = index_to_grid;
}

void DensityGridBuilder::require_room(std::size_t bricks) const {
    if (bricks > most_bricks - grid_.bricks.size())
        throw Error(
            fmt::format("too large: more than {} bricks of {} voxels", most_bricks, DensityGrid::brick_size));
}

void DensityGridBuilder::brick(const glm::ivec3& lower, const grids::BrickValues& values) {
    std::ranges::for_each(values, require_density);
    if (std::ranges::all_of(values, [](float value) { return value == 0; })) return;
    require_place(lower, DensityGrid::side);
    require_room(1);
    grid_.bricks.push_back(lower);
    grid_.values.insert(grid_.values.end(), values.begin(), values.end());
}

void DensityGridBuilder::tile(const glm::ivec3& lower, int side, float value) {
    require_density(value);
    if (value == 0) return;
    if (side != 8 && side != 128 && side != 4096) throw Error("damaged: a tile of a wrong size");
    require_place(lower, side);
    const int across = side / DensityGrid::side;
    const std::size_t count = std::size_t(across) * across * across;
    require_room(count);
    for (int z = 0; z < across; ++z)
        for (int y = 0; y < across; ++y)
            for (int x = 0; x < across; ++x)
                grid_.bricks.push_back(lower + DensityGrid::side * glm::ivec3(x, y, z));
    grid_.values.insert(grid_.values.end(), count * DensityGrid::brick_size, value);
}

void DensityGridBuilder::require_distinct_bricks() const {
    std::vector<glm::ivec3> sorted = grid_.bricks;
    std::ranges::sort(sorted, [](const glm::ivec3& a, const glm::ivec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    if (std::ranges::adjacent_find(sorted) != sorted.end()) throw Error("damaged: two bricks lie in one place");
}

void DensityGridBuilder::measure() {
    glm::ivec3 low(farthest), high(-farthest);
    const float* value = grid_.values.data();
    for (const glm::ivec3& brick : grid_.bricks)
        for (int z = 0; z < DensityGrid::side; ++z)
            for (int y = 0; y < DensityGrid::side; ++y)
                for (int x = 0; x < DensityGrid::side; ++x, ++value) {
                    if (*value == 0) continue;
                    const glm::ivec3 at = brick + glm::ivec3(x, y, z);
                    low = glm::min(low, at);
                    high = glm::max(high, at);
                    grid_.greatest = std::max(grid_.greatest, *value);
                }
    for (int axis = 0; axis < 3; ++axis)
        if (high[axis] - low[axis] >= longest_side)
            throw Error(fmt::format("too large: {} voxels long, at most {} expected", high[axis] - low[axis] + 1,
                                    longest_side));
    grid_.lower = low;
    grid_.upper = high;
}

DensityGrid DensityGridBuilder::finish() {
    if (!transform_) throw Error("damaged: it has no transform");
    grid_.index_to_grid = *transform_;
    require_distinct_bricks();
    if (!grid_.empty()) measure();
    return std::move(grid_);
}

}  // namespace tyndall
