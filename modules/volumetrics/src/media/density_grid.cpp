#include "volumetrics/density_grid.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "engine/core/error.h"
#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {
namespace {

/// Three axes at right angles, the first along the first column, right-handed. Of a rotation and scales it is the
/// rotation, but for mirrored axes.
glm::dmat3 axes_of(const glm::dmat3& m) {
    const glm::dvec3 x = glm::normalize(m[0]);
    const glm::dvec3 y = glm::normalize(m[1] - glm::dot(m[1], x) * x);
    return {x, y, glm::cross(x, y)};
}

}  // namespace

std::shared_ptr<const DensityGrid> density_grid(std::span<const glm::ivec3> bricks, std::span<const float> values,
                                                std::shared_ptr<const void> owner) {
    auto grid = std::make_shared<DensityGrid>(DensityGrid{bricks, values, std::move(owner)});
    if (values.size() != bricks.size() * DensityGrid::brick_size)
        throw Error(fmt::format("volumetrics: density grid of {} bricks with {} values, {} expected", bricks.size(),
                                values.size(), bricks.size() * DensityGrid::brick_size));
    static std::atomic<std::uint32_t> last = 0;
    grid->number = ++last;
    grid->lower = glm::ivec3(std::numeric_limits<int>::max());
    grid->upper = glm::ivec3(std::numeric_limits<int>::min());
    std::set<std::tuple<int, int, int>> seen;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const glm::ivec3 b = bricks[i];
        if ((b & 7) != glm::ivec3(0) || !seen.insert({b.x, b.y, b.z}).second)
            throw Error(
                fmt::format("volumetrics: brick at voxel {} {} {} of a density grid, multiples of 8 and no "
                            "two alike expected",
                            b.x, b.y, b.z));
        for (int v = 0; v < DensityGrid::brick_size; ++v) {
            const float value = values[i * DensityGrid::brick_size + static_cast<std::size_t>(v)];
            if (!std::isfinite(value) || value < 0)
                throw Error(
                    fmt::format("volumetrics: value {} of a density grid, a number from 0 on expected", value));
            if (value == 0) continue;
            const glm::ivec3 voxel = b + glm::ivec3(v & 7, v >> 3 & 7, v >> 6);
            grid->lower = glm::min(grid->lower, voxel);
            grid->upper = glm::max(grid->upper, voxel);
            grid->greatest = std::max(grid->greatest, value);
            grid->sum += double(value);
        }
    }
    if (grid->greatest == 0) grid->lower = glm::ivec3(0), grid->upper = glm::ivec3(-1);
    return grid;
}

void set_grid(LocalMedium& medium, std::shared_ptr<const DensityGrid> grid, const glm::dmat4& voxel_to_world,
              bool nearest) {
    if (!(std::abs(glm::determinant(voxel_to_world)) > 0))
        throw Error("volumetrics: voxel_to_world of a density grid cannot be inverted");
    medium.shape = Shape::grid;
    medium.nearest = nearest;
    const double reach = nearest ? 0.5 : 1;  // voxels around the outermost centres
    const glm::dvec3 lower = glm::dvec3(grid->lower) - reach, upper = glm::dvec3(grid->upper) + reach;
    const glm::dmat3 axes = axes_of(glm::dmat3(voxel_to_world));
    glm::dvec3 least(std::numeric_limits<double>::max()), most(std::numeric_limits<double>::lowest());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 voxel{corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                               corner & 4 ? upper.z : lower.z};
        const glm::dvec3 p = glm::transpose(axes) * glm::dvec3(voxel_to_world * glm::dvec4(voxel, 1));
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
    medium.center = glm::vec3(axes * (0.5 * (least + most)));
    medium.half_extent = grid->greatest > 0 ? glm::vec3(0.5 * (most - least)) : glm::vec3(0);
    medium.rotation = glm::quat(glm::quat_cast(axes));
    medium.world_to_voxel = glm::inverse(voxel_to_world);
    medium.grid = std::move(grid);
}

}  // namespace tyndall::volumetrics
