#pragma once

#include <vector>

#include "reference/geometry.h"

namespace tyndall::reference {

/// Where along the straight line of texture coordinates from `from` (u = 0) to `to` (u = 1) a masked material is
/// opaque, of u in `part`: exact for bilinear look-up, as alpha is a quadratic of u between two texel centres.
/// After a million texels the rest counts as the last one did.
[[nodiscard]] std::vector<Interval> opaque_parts(const Scene& scene, const Material& material, dvec2 from, dvec2 to,
                                                 Interval part);

}  // namespace tyndall::reference
