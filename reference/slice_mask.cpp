#include "reference/slice_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tyndall::reference {
namespace {

constexpr int most_cells = 1 << 20;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// One texture coordinate along the line, in texels from the first one's centre, and the cell between centres that
/// u has come to.
struct Axis {
    double start, slope;
    double cell;      ///< its lower edge
    int index, size;  ///< the same, wrapped

    Axis(double from, double to, int texels, double u) : start(from * texels - 0.5), slope((to - from) * texels) {
        size = texels;
        cell = std::floor(at(u));
        index = static_cast<int>(std::clamp(cell - size * std::floor(cell / size), 0.0, size - 1.0));
    }
    [[nodiscard]] double at(double u) const { return start + slope * u; }
    [[nodiscard]] int next_index() const { return index + 1 == size ? 0 : index + 1; }
    /// Where the line leaves the cell.
    [[nodiscard]] double exit() const {
        if (slope == 0) return infinity;
        return ((slope > 0 ? cell + 1 : cell) - start) / slope;
    }
    void step() {
        cell += slope > 0 ? 1 : -1;
        index = slope > 0 ? next_index() : (index == 0 ? size : index) - 1;
    }
};

/// Alpha less the cutoff at the corners of a cell.
struct Cell {
    std::array<double, 4> corner;

    [[nodiscard]] double at(double x, double y) const {
        return (corner[0] * (1 - x) + corner[1] * x) * (1 - y) + (corner[2] * (1 - x) + corner[3] * x) * y;
    }
    [[nodiscard]] bool all_opaque() const {
        return std::ranges::all_of(corner, [](double v) { return v >= 0; });
    }
    [[nodiscard]] bool all_clear() const {
        return std::ranges::all_of(corner, [](double v) { return v < 0; });
    }
};

/// The zeros in (0, 1) of the quadratic with values f at 0, 1/2 and 1; 2 where there is none. Ascending.
std::array<double, 2> zeros(double f0, double f_half, double f1) {
    const double a = 2 * (f0 - 2 * f_half + f1), b = f1 - f0 - a, discriminant = b * b - 4 * a * f0;
    std::array<double, 2> out{2, 2};
    if (discriminant < 0) return out;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    out = {q / a, f0 / q};
    for (double& zero : out)
        if (!(zero > 0 && zero < 1)) zero = 2;
    if (out[0] > out[1]) std::swap(out[0], out[1]);
    return out;
}

void add(std::vector<Interval>& opaque, Interval piece) {
    if (!opaque.empty() && opaque.back().end == piece.begin)
        opaque.back().end = piece.end;
    else
        opaque.push_back(piece);
}

/// What is opaque of one cell's stretch of the line.
void add_cell(const Cell& cell, const Axis& x, const Axis& y, Interval stretch, std::vector<Interval>& opaque) {
    if (cell.all_clear()) return;
    if (cell.all_opaque()) return add(opaque, stretch);
    const auto excess = [&](double s) {
        const double u = stretch.begin + s * (stretch.end - stretch.begin);
        return cell.at(x.at(u) - x.cell, y.at(u) - y.cell);
    };
    const std::array<double, 2> zero = zeros(excess(0), excess(0.5), excess(1));
    const std::array<double, 4> edge{0, std::min(zero[0], 1.0), std::min(zero[1], 1.0), 1};
    const auto at = [&](double s) {
        return s == 1 ? stretch.end : stretch.begin + s * (stretch.end - stretch.begin);
    };
    for (std::size_t i = 0; i < 3; ++i)
        if (edge[i] < edge[i + 1] && excess(0.5 * (edge[i] + edge[i + 1])) >= 0)
            add(opaque, {at(edge[i]), at(edge[i + 1])});
}

}  // namespace

std::vector<Interval> opaque_parts(const Scene& scene, const Material& material, dvec2 from, dvec2 to,
                                   Interval part) {
    const double factor = material.base_color.a, cutoff = material.alpha_cutoff;
    if (material.base_color_picture < 0) return factor >= cutoff ? std::vector{part} : std::vector<Interval>{};
    const Picture& picture = scene.pictures[static_cast<std::size_t>(material.base_color_picture)];
    const auto excess = [&](int column, int row) {
        const auto texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.size.x) +
                           static_cast<std::size_t>(column);
        return factor * (picture.rgba[texel * 4 + 3] / 255.0) - cutoff;
    };

    Axis x(from.x, to.x, picture.size.x, part.begin), y(from.y, to.y, picture.size.y, part.begin);
    std::vector<Interval> opaque;
    double u = part.begin;
    for (int i = 0; u < part.end; ++i) {
        const double exit = std::min(x.exit(), y.exit());
        const Interval stretch{u, i < most_cells ? std::clamp(exit, u, part.end) : part.end};
        const int right = x.next_index(), below = y.next_index();
        if (stretch.begin < stretch.end)
            add_cell(
                {{excess(x.index, y.index), excess(right, y.index), excess(x.index, below), excess(right, below)}},
                x, y, stretch, opaque);
        u = stretch.end;
        (x.exit() <= y.exit() ? x : y).step();
    }
    return opaque;
}

}  // namespace tyndall::reference
