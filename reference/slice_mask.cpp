#include "reference/slice_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/surface_texture.h"

namespace tyndall::reference {
namespace {

constexpr int most_cells = 1 << 20;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// One texture coordinate along the line, in cells between texel centres (or of texels, where the nearest counts),
/// and the cell that u has come to.
struct Axis {
    double start, slope;
    double cell;                       ///< its lower edge
    std::array<std::size_t, 2> texel;  ///< at its two edges
    int size;
    Wrap wrap;
    bool nearest;

    Axis(double from, double to, int texels, Wrap wrap_, bool nearest_, double u)
        : start(from * texels - (nearest_ ? 0 : 0.5)),
          slope((to - from) * texels),
          cell(std::floor(at(u))),
          texel{},
          size(texels),
          wrap(wrap_),
          nearest(nearest_) {
        find_texels();
    }
    [[nodiscard]] double at(double u) const { return start + slope * u; }
    /// Where the line leaves the cell.
    [[nodiscard]] double exit() const {
        if (slope == 0) return infinity;
        return ((slope > 0 ? cell + 1 : cell) - start) / slope;
    }
    void step() {
        cell += slope > 0 ? 1 : -1;
        find_texels();
    }

  private:
    void find_texels() {
        texel = {texel_of(cell, size, wrap), nearest ? texel_of(cell, size, wrap) : texel_of(cell + 1, size, wrap)};
    }
};

/// The picture's alpha at the corners of a cell.
struct Cell {
    std::array<double, 4> corner;

    [[nodiscard]] double at(double x, double y) const {
        return (corner[0] * (1 - x) + corner[1] * x) * (1 - y) + (corner[2] * (1 - x) + corner[3] * x) * y;
    }
};

/// The zeros in (0, 1) of a s² + b s + c, ascending; 1 where there is none.
std::array<double, 2> zeros(double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    std::array<double, 2> out{1, 1};
    if (discriminant < 0) return out;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    out = {q / a, c / q};
    for (double& zero : out)
        if (!(zero > 0 && zero < 1)) zero = 1;
    if (out[0] > out[1]) std::swap(out[0], out[1]);
    return out;
}

/// 0, the zeros in (0, 1) of the cubic with values f at 0, 1/3, 2/3 and 1, and 1: ascending; 1 for those it lacks.
std::array<double, 5> signs_change(const std::array<double, 4>& f) {
    const double d = f[0], a = 4.5 * (f[3] - 3 * f[2] + 3 * f[1] - f[0]),
                 b = 4.5 * (2 * f[0] - 5 * f[1] + 4 * f[2] - f[3]), c = f[3] - d - a - b;
    const auto at = [&](double s) { return ((a * s + b) * s + c) * s + d; };
    std::array<double, 5> out{0, 1, 1, 1, 1};
    const double least = 1e-9 * (std::abs(f[0]) + std::abs(f[1]) + std::abs(f[2]) + std::abs(f[3]));
    if (std::abs(a) <= least) {
        const std::array<double, 2> zero = zeros(b, c, d);
        return {0, zero[0], zero[1], 1, 1};
    }
    // Between its extremes it is monotonous.
    const std::array<double, 2> extreme = zeros(3 * a, 2 * b, c);
    const std::array<double, 4> edge{0, extreme[0], extreme[1], 1};
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double low = edge[i], high = edge[i + 1];
        if (!(low < high) || at(low) * at(high) >= 0) continue;
        const bool rises = at(low) < 0;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            ((at(middle) < 0) == rises ? low : high) = middle;
        }
        out[++found] = 0.5 * (low + high);
    }
    return out;
}

void add(std::vector<Interval>& opaque, Interval piece) {
    if (!opaque.empty() && opaque.back().end == piece.begin)
        opaque.back().end = piece.end;
    else
        opaque.push_back(piece);
}

/// What is opaque of one cell's stretch of the line; `factor` multiplies the picture's alpha.
template <class Factor>
void add_cell(const Cell& cell, const Axis& x, const Axis& y, Interval stretch, double cutoff, Factor factor,
              std::vector<Interval>& opaque) {
    const auto [least, most] = std::minmax({factor(stretch.begin), factor(stretch.end)});
    const auto [low, high] = std::ranges::minmax(cell.corner);
    if (high * most < cutoff) return;
    if (low * least >= cutoff) return add(opaque, stretch);
    const auto at = [&](double s) {
        return s == 1 ? stretch.end : stretch.begin + s * (stretch.end - stretch.begin);
    };
    const auto excess = [&](double s) {
        const double u = at(s);
        return factor(u) * cell.at(x.at(u) - x.cell, y.at(u) - y.cell) - cutoff;
    };
    const std::array<double, 5> edge = signs_change({excess(0), excess(1.0 / 3), excess(2.0 / 3), excess(1)});
    for (std::size_t i = 0; i < 4; ++i)
        if (edge[i] < edge[i + 1] && excess(0.5 * (edge[i] + edge[i + 1])) >= 0)
            add(opaque, {at(edge[i]), at(edge[i + 1])});
}

}  // namespace

std::vector<Interval> opaque_parts(const Scene& scene, const Material& material, const MaskPoint& from,
                                   const MaskPoint& to, Interval part) {
    const double cutoff = material.alpha_cutoff;
    const auto factor = [&](double u) {
        return double{material.base_color.a} * (from.alpha + u * (to.alpha - from.alpha));
    };
    static const Picture white{"white", {1, 1}, {255, 255, 255, 255}};
    const bool plain = material.base_color_picture < 0;
    const Picture& picture = plain ? white : scene.pictures[static_cast<std::size_t>(material.base_color_picture)];
    const auto alpha = [&](std::size_t column, std::size_t row) {
        return picture.rgba[(row * static_cast<std::size_t>(picture.size.x) + column) * 4 + 3] / 255.0;
    };

    const Sampling& how = picture.sampling;
    Axis x(from.uv.x, plain ? from.uv.x : to.uv.x, picture.size.x, how.u, how.nearest, part.begin);
    Axis y(from.uv.y, plain ? from.uv.y : to.uv.y, picture.size.y, how.v, how.nearest, part.begin);
    std::vector<Interval> opaque;
    double u = part.begin;
    for (int i = 0; u < part.end; ++i) {
        const double exit = std::min(x.exit(), y.exit());
        const Interval stretch{u, i < most_cells ? std::clamp(exit, u, part.end) : part.end};
        if (stretch.begin < stretch.end)
            add_cell({{alpha(x.texel[0], y.texel[0]), alpha(x.texel[1], y.texel[0]), alpha(x.texel[0], y.texel[1]),
                       alpha(x.texel[1], y.texel[1])}},
                     x, y, stretch, cutoff, factor, opaque);
        u = stretch.end;
        (x.exit() <= y.exit() ? x : y).step();
    }
    return opaque;
}

}  // namespace tyndall::reference
