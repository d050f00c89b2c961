#pragma once

#include "media/froxel_media.h"

namespace tyndall::volumetrics {

/// RG32UI: the runs of slices in which local media hardly change, for the march with light in parts; see
/// shaders/volumetrics/media/froxel_runs.comp. There are local media.
[[nodiscard]] TextureRef add_froxel_runs(Frame& frame, const FroxelMedia& froxels);

}  // namespace tyndall::volumetrics
