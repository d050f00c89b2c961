#pragma once

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

class Frame;

/// Froxel volumes of the local media in view: RGBA16F 3D textures, see shaders/volumetrics/media/inject_media.comp.
/// All empty without any.
struct FroxelMedia {
    TextureRef scattering, extinction, emission;  ///< emission only where some local medium emits
};

/// This frame's: the first call adds the passes, and its columns are all that is filled.
[[nodiscard]] const FroxelMedia& froxel_media(Frame& frame, TextureRef columns);
/// Likewise: the farthest view depth [m] seen through each column, behind which no froxel is filled. R32F, see
/// shaders/volumetrics/media/froxel_columns.frag.
[[nodiscard]] TextureRef froxel_columns(Frame& frame);
/// That of the transparents in it which nothing hides; 0 where there are none, whose froxels nothing fills.
[[nodiscard]] TextureRef transparent_columns(Frame& frame);

}  // namespace tyndall::volumetrics
