#pragma once

#include <vector>

#include "reference/geometry.h"
#include "reference/slice.h"

namespace tyndall::reference {

/// What transparent surfaces leave of a light along a ray: the product of the filters of those that it crosses on
/// its way there, whatever the angle and the side,
///
///     filter = (1 - alpha) + alpha * transmission * colour
///
/// with alpha and colour of the base colour (factor, texture, vertices; linear). Alpha 0: clear; alpha 1 and
/// transmission 0: opaque.
class Tint {
  public:
    /// Clear.
    Tint() = default;
    /// The geometry must outlive this.
    explicit Tint(const Geometry::Impl& geometry) : geometry_(&geometry) {}

    /// A transparent triangle that tints a stretch of the ray.
    struct Pane {
        Interval on_ray;
        std::uint32_t triangle;
        Shadow shadow;
    };
    void add(const Pane& pane) { panes_.push_back(pane); }

    /// At t metres along the ray.
    [[nodiscard]] dvec3 at(double t) const;
    /// Where it jumps (behind the edges of triangles, and where the ray crosses them), and where the borders of
    /// texels give it kinks: of one triangle and picture axis all borders, or about 16 of them if there are more.
    [[nodiscard]] std::vector<double> knots() const;

  private:
    const Geometry::Impl* geometry_ = nullptr;
    std::vector<Pane> panes_;
};

}  // namespace tyndall::reference
