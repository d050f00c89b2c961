#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "engine/scene/density_grid.h"

namespace tyndall::test {

/// Voxels by their coordinates, and what a density grid of them must be, as simply as it can be written.
struct Voxels {
    std::map<std::array<int, 3>, float> values;

    void set(glm::ivec3 voxel, float value) { values[{voxel.x, voxel.y, voxel.z}] = value; }
    void fill(glm::ivec3 lower, glm::ivec3 upper, float value) {
        for (int z = lower.z; z <= upper.z; ++z)
            for (int y = lower.y; y <= upper.y; ++y)
                for (int x = lower.x; x <= upper.x; ++x) set({x, y, z}, value);
    }
    [[nodiscard]] double get(int x, int y, int z) const {
        const auto found = values.find({x, y, z});
        return found == values.end() ? 0.0 : static_cast<double>(found->second);
    }
    [[nodiscard]] double at(glm::dvec3 p, bool nearest) const {
        const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
        if (nearest) return get(whole(p.x + 0.5), whole(p.y + 0.5), whole(p.z + 0.5));
        const int i = whole(p.x), j = whole(p.y), k = whole(p.z);
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const int x = i + (corner & 1), y = j + (corner >> 1 & 1), z = k + (corner >> 2 & 1);
            sum += get(x, y, z) * (1 - std::abs(p.x - x)) * (1 - std::abs(p.y - y)) * (1 - std::abs(p.z - z));
        }
        return sum;
    }
    /// Where o + t d within [begin, end] meets any plane on which the density has an edge or a kink, rising.
    [[nodiscard]] std::vector<double> crossings(glm::dvec3 o, glm::dvec3 d, double begin, double end,
                                                bool nearest) const {
        std::vector<double> t{begin, end};
        glm::ivec3 low(1 << 30), high(-(1 << 30));
        for (const auto& [at, value] : values) {
            low = glm::min(low, glm::ivec3(at[0], at[1], at[2]));
            high = glm::max(high, glm::ivec3(at[0], at[1], at[2]));
        }
        for (int axis = 0; axis < 3; ++axis)
            for (int k = low[axis] - 2; k <= high[axis] + 2; ++k) {
                const double crossing = (k + (nearest ? 0.5 : 0.0) - o[axis]) / d[axis];
                if (crossing > begin && crossing < end) t.push_back(crossing);
            }
        std::sort(t.begin(), t.end());
        return t;
    }
    /// Of at(o + t d) over [begin, end]: cubic or constant between crossings, for which Simpson's rule is exact.
    [[nodiscard]] double integral(glm::dvec3 o, glm::dvec3 d, double begin, double end, bool nearest) const {
        const std::vector<double> t = crossings(o, d, begin, end, nearest);
        double sum = 0;
        for (std::size_t i = 0; i + 1 < t.size(); ++i) {
            const double a = t[i], b = t[i + 1], middle = 0.5 * (a + b);
            if (nearest)
                sum += (b - a) * at(o + middle * d, true);
            else
                sum += (b - a) / 6 * (at(o + a * d, false) + 4 * at(o + middle * d, false) + at(o + b * d, false));
        }
        return sum;
    }
    [[nodiscard]] std::shared_ptr<DensityGrid> grid() const {
        auto grid = std::make_shared<DensityGrid>();
        std::map<std::array<int, 3>, std::size_t> bricks;
        constexpr int side = DensityGrid::side;
        glm::ivec3 low(1 << 30), high(-(1 << 30));
        for (const auto& [at, value] : values) {
            if (!(value > 0)) continue;
            const glm::ivec3 voxel(at[0], at[1], at[2]);
            const glm::ivec3 brick = glm::ivec3(glm::floor(glm::dvec3(voxel) / double(side))) * side;
            const auto [place, fresh] = bricks.insert({{brick.x, brick.y, brick.z}, grid->bricks.size()});
            if (fresh) {
                grid->bricks.push_back(brick);
                grid->values.resize(grid->values.size() + DensityGrid::brick_size);
            }
            const glm::ivec3 p = voxel - brick;
            grid->values[place->second * DensityGrid::brick_size +
                         static_cast<std::size_t>(p.x + side * (p.y + side * p.z))] = value;
            low = glm::min(low, voxel);
            high = glm::max(high, voxel);
            grid->greatest = std::max(grid->greatest, value);
        }
        if (!grid->bricks.empty()) {
            grid->lower = low;
            grid->upper = high;
        }
        return grid;
    }
};

}  // namespace tyndall::test
