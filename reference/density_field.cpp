#include "reference/density_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/error.h"

namespace tyndall::reference {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double slowest = 1e-290;                           ///< whose inverse, times a coordinate, is finite
constexpr int farthest = 1 << 30;                            ///< coordinate of a voxel
constexpr std::int64_t most_blocks = std::int64_t{1} << 28;  ///< of a table: 1 GiB

template <int stride>
double trilinear(const float* v, dvec3 p) {
    constexpr int y = stride, z = stride * stride;
    const auto along_x = [&](int i) { return v[i] + p.x * (static_cast<double>(v[i + 1]) - v[i]); };
    const double near_low = along_x(0), near_high = along_x(y);
    const double far_low = along_x(z), far_high = along_x(z + y);
    const double near = near_low + p.y * (near_high - near_low);
    const double far = far_low + p.y * (far_high - far_low);
    return near + p.z * (far - near);
}
constexpr auto between_centres = trilinear<DensityGrid::side + 1>;

/// Which of the three is least.
int first_of(dvec3 t) {
    if (t.x <= t.y) return t.x <= t.z ? 0 : 2;
    return t.y <= t.z ? 1 : 2;
}

}  // namespace

/// A ray, and where it crosses the planes of whole coordinates.
struct DensityField::Planes {
    dvec3 origin, direction, inverse;
    glm::bvec3 moves, rises;
    glm::ivec3 step;
    Planes(dvec3 o, dvec3 d)
        : origin(o),
          direction(d),
          inverse(1.0 / d),
          moves(glm::greaterThan(glm::abs(d), dvec3(slowest))),
          rises(d.x > 0, d.y > 0, d.z > 0),
          step(rises.x ? 1 : -1, rises.y ? 1 : -1, rises.z ? 1 : -1) {}
    [[nodiscard]] double crossing(int axis, int coordinate) const {
        return moves[axis] ? (coordinate - origin[axis]) * inverse[axis] : never;
    }
    /// Out of a cube, along one axis.
    [[nodiscard]] double exit(int axis, int lowest, int edge) const {
        return crossing(axis, lowest + (rises[axis] ? edge : 0));
    }
    [[nodiscard]] glm::ivec3 cell_at(double t) const { return glm::ivec3(glm::floor(origin + t * direction)); }
};

DensityField::Table::Table(glm::ivec3 lower_, glm::ivec3 upper) : lower(lower_) {
    const glm::i64vec3 wide = glm::i64vec3(upper) - glm::i64vec3(lower) + std::int64_t{1};
    if (wide.x > most_blocks || wide.y > most_blocks || wide.z > most_blocks ||
        wide.x * wide.y > most_blocks / wide.z)
        throw Error(fmt::format("reference: grid of {} x {} x {} voxels, at most {} times {} expected",
                                side * wide.x, side * wide.y, side * wide.z, most_blocks, DensityGrid::brick_size));
    size = glm::ivec3(wide);
    numbers.assign(static_cast<std::size_t>(wide.x * wide.y * wide.z), -1);
}

std::size_t DensityField::Table::index(glm::ivec3 block) const {
    const auto p = glm::u64vec3(block - lower);
    return p.x + static_cast<std::size_t>(size.x) * (p.y + static_cast<std::size_t>(size.y) * p.z);
}

std::int32_t DensityField::Table::find(glm::ivec3 block) const {
    const glm::ivec3 p = block - lower;
    if (glm::any(glm::lessThan(p, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(p, size))) return -1;
    return numbers[index(block)];
}

DensityField::DensityField(const DensityGrid& grid, bool nearest)
    : nearest_(nearest), stride_(nearest ? side : side + 1), offset_(nearest ? 0.5 : 0.0) {
    if (grid.empty()) return;
    const dvec3 reach(nearest ? 0.5 : 1.0);
    lower_ = dvec3(grid.lower) - reach;
    upper_ = dvec3(grid.upper) + reach;
    glm::ivec3 first(std::numeric_limits<int>::max()), last(std::numeric_limits<int>::min());
    for (const glm::ivec3 brick : grid.bricks) {
        if (glm::any(glm::greaterThan(glm::abs(glm::dvec3(brick)), dvec3(farthest))))
            throw Error(fmt::format("reference: voxel at {} {} {}, at most {} expected", brick.x, brick.y, brick.z,
                                    farthest));
        first = glm::min(first, brick / side);
        last = glm::max(last, brick / side);
    }
    Table bricks(first, last);
    for (std::size_t i = 0; i < grid.bricks.size(); ++i)
        bricks.numbers[bricks.index(grid.bricks[i] / side)] = static_cast<std::int32_t>(i);
    const int below = nearest ? 0 : 1;
    table_ = Table(first - below, last);
    for (const glm::ivec3 brick : grid.bricks)
        for (int z = -below; z <= 0; ++z)
            for (int y = -below; y <= 0; ++y)
                for (int x = -below; x <= 0; ++x) add_block(brick / side + glm::ivec3(x, y, z), grid, bricks);
}

// Nothing where it is there already, or empty.
void DensityField::add_block(glm::ivec3 block, const DensityGrid& grid, const Table& bricks) {
    std::int32_t& number = table_.numbers[table_.index(block)];
    if (number >= 0) return;
    Block made;
    made.values.resize(static_cast<std::size_t>(stride_ * stride_ * stride_));
    bool any = false;
    const auto fill = [&](glm::ivec3 p) {
        const std::int32_t brick = bricks.find(block + p / side);
        if (brick < 0) return;
        const glm::ivec3 q = p % side;
        const float value = grid.values[static_cast<std::size_t>(brick) * DensityGrid::brick_size +
                                        static_cast<std::size_t>(q.x + side * (q.y + side * q.z))];
        if (value == 0) return;
        made.values[static_cast<std::size_t>(p.x + stride_ * (p.y + stride_ * p.z))] = value;
        any = true;
        const glm::ivec3 low = glm::max(p - (stride_ - side), 0), high = glm::min(p, side - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    made.occupied[static_cast<std::size_t>(z)] |= std::uint64_t{1} << (side * y + x);
    };
    for (int z = 0; z < stride_; ++z)
        for (int y = 0; y < stride_; ++y)
            for (int x = 0; x < stride_; ++x) fill({x, y, z});
    if (!any) return;
    number = static_cast<std::int32_t>(blocks_.size());
    blocks_.push_back(std::move(made));
}

double DensityField::at(dvec3 point) const {
    if (!glm::all(glm::greaterThanEqual(point, lower_)) || !glm::all(glm::lessThanEqual(point, upper_))) return 0;
    const dvec3 p = point + offset_;
    const glm::ivec3 cell(glm::floor(p));
    const glm::ivec3 block = cell >> 3;
    static_assert(side == 1 << 3);
    const std::int32_t number = table_.find(block);
    if (number < 0) return 0;
    const float* v = corner(blocks_[static_cast<std::size_t>(number)], cell - block * side);
    return nearest_ ? *v : between_centres(v, p - dvec3(cell));
}

// Calls visit(corner, from, begin, end) for the stretches of cells that are not empty, rising: `corner` is the
// cell's lowest voxel, `from` the ray's origin seen from there.
template <class Visit>
void DensityField::walk(dvec3 origin, dvec3 direction, Interval part, Visit visit) const {
    origin += offset_;
    const Planes planes(origin, direction);
    for (int i = 0; i < 3; ++i) {
        const int low = table_.lower[i] * side, high = low + table_.size[i] * side;
        if (!planes.moves[i]) {
            if (!(origin[i] >= low && origin[i] < high)) return;
            continue;
        }
        const double a = planes.crossing(i, low), b = planes.crossing(i, high);
        part = {std::max(part.begin, std::min(a, b)), std::min(part.end, std::max(a, b))};
    }
    if (!(part.begin < part.end)) return;
    glm::ivec3 block = glm::clamp(planes.cell_at(part.begin) >> 3, table_.lower, table_.lower + table_.size - 1);
    dvec3 exits;
    for (int i = 0; i < 3; ++i) exits[i] = planes.exit(i, block[i] * side, side);
    for (double t = part.begin;;) {
        const int axis = first_of(exits);
        const double out = std::min(exits[axis], part.end);
        if (t < out) {
            if (table_.numbers[table_.index(block)] >= 0) walk_block(planes, {t, out}, block, visit);
            t = out;
        }
        if (!(exits[axis] < part.end)) return;
        block[axis] += planes.step[axis];
        if (block[axis] < table_.lower[axis] || block[axis] >= table_.lower[axis] + table_.size[axis]) return;
        exits[axis] = planes.exit(axis, block[axis] * side, side);
    }
}

template <class Visit>
void DensityField::walk_block(const Planes& planes, Interval part, glm::ivec3 at, Visit& visit) const {
    const Block& block = blocks_[static_cast<std::size_t>(table_.numbers[table_.index(at)])];
    const glm::ivec3 lowest = at * side;
    glm::ivec3 cell = glm::clamp(planes.cell_at(part.begin) - lowest, 0, side - 1);
    dvec3 exits;
    for (int i = 0; i < 3; ++i) exits[i] = planes.exit(i, lowest[i] + cell[i], 1);
    for (double t = part.begin;;) {
        const int axis = first_of(exits);
        const double out = std::min(exits[axis], part.end);
        if (t < out) {
            if (block.has(cell)) visit(corner(block, cell), planes.origin - dvec3(lowest + cell), t, out);
            t = out;
        }
        if (!(exits[axis] < part.end)) return;
        cell[axis] += planes.step[axis];
        if (cell[axis] < 0 || cell[axis] >= side) return;
        exits[axis] = planes.exit(axis, lowest[axis] + cell[axis], 1);
    }
}

// Gauss's 2-point rule is exact for cubics.
double DensityField::integral(dvec3 origin, dvec3 direction, Interval part) const {
    double sum = 0;
    if (nearest_) {
        walk(origin, direction, part,
             [&](const float* v, dvec3, double begin, double end) { sum += (end - begin) * *v; });
        return sum;
    }
    const double node = 1 / std::sqrt(3.0);
    walk(origin, direction, part, [&](const float* v, dvec3 from, double begin, double end) {
        const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
        sum += half * (between_centres(v, from + (middle - node * half) * direction) +
                       between_centres(v, from + (middle + node * half) * direction));
    });
    return sum;
}

DensityLine DensityField::line(dvec3 origin, dvec3 direction, Interval part, double factor) const {
    DensityLine line;
    walk(origin, direction, part, [&](const float* v, dvec3 from, double begin, double end) {
        std::array<double, 4> density;
        for (std::size_t i = 0; i < 4; ++i) {
            const double t = begin + (end - begin) * static_cast<double>(i) / 3;
            density[i] = factor * (nearest_ ? *v : between_centres(v, from + t * direction));
        }
        line.add(begin, end, density);
    });
    return line;
}

}  // namespace tyndall::reference
