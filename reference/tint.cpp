#include "reference/tint.h"

#include <algorithm>
#include <cmath>

#include "reference/geometry_impl.h"

namespace tyndall::reference {
namespace {

/// Adds the u in `part` at which a texture coordinate, `from` at u = 0 and `to` at u = 1, comes to a border of
/// texels.
void add_borders(double from, double to, int texels, bool nearest, Interval part, std::vector<double>& borders) {
    constexpr double most = 16;
    const double start = from * texels - (nearest ? 0 : 0.5), slope = (to - from) * texels;
    if (slope == 0) return;
    const auto [first, last] = std::minmax({start + slope * part.begin, start + slope * part.end});
    const double step = std::max(1.0, std::ceil((last - first) / most));
    for (double border = std::floor(first) + 1; border < last; border += step)
        borders.push_back((border - start) / slope);
}

}  // namespace

dvec3 Tint::at(double t) const {
    dvec3 product(1);
    for (const Pane& pane : panes_)  // half open: an edge that two triangles share counts once
        if (pane.on_ray.begin < t && t <= pane.on_ray.end)
            product *= geometry_->filter(geometry_->glass[pane.triangle], pane.shadow.weights_at(t));
    return product;
}

std::vector<double> Tint::knots() const {
    std::vector<double> knots, borders;
    for (const Pane& pane : panes_) {
        knots.insert(knots.end(), {pane.on_ray.begin, pane.on_ray.end});
        const Triangle& triangle = geometry_->glass[pane.triangle];
        const int index = geometry_->material(triangle).base_color_picture;
        if (index < 0) continue;
        const Picture& picture = geometry_->scene.pictures[static_cast<std::size_t>(index)];
        const dvec2 from = geometry_->uv(triangle, pane.shadow.weights[0]),
                    to = geometry_->uv(triangle, pane.shadow.weights[1]);
        borders.clear();
        for (int axis = 0; axis < 2; ++axis)
            add_borders(from[axis], to[axis], picture.size[axis], picture.sampling.nearest, pane.shadow.part,
                        borders);
        for (const double u : borders) knots.push_back(pane.shadow.ray_at(u));
    }
    return knots;
}

}  // namespace tyndall::reference
