#pragma once

#include <vector>

#include "reference/geometry.h"

namespace tyndall::reference {

/// What the vertices say at a point of a triangle.
struct MaskPoint {
    dvec2 uv;
    double alpha;
};

/// Where along the straight line from `from` (u = 0) to `to` (u = 1) a masked material is opaque, of u in `part`:
/// exact, as alpha is a cubic of u between two texel centres, and a quadratic where the vertices' alpha is one.
/// After a million texels the rest counts as the last one did.
[[nodiscard]] std::vector<Interval> opaque_parts(const Scene& scene, const Material& material,
                                                 const MaskPoint& from, const MaskPoint& to, Interval part);

}  // namespace tyndall::reference
