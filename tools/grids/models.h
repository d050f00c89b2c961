#pragma once

#include "tools/grids/voxels.h"

namespace tyndall::grid_models {

/// A cumulus of 640 m by 512 m with a level base at y = 0 and a top at about 300 m; density 0 to 1.
[[nodiscard]] Voxels make_cumulus();
/// Smoke that rises from the origin, curls, and spreads to about 2 m at a height of 3 m; density 0 to 1.
[[nodiscard]] Voxels make_smoke();

}  // namespace tyndall::grid_models
