#pragma once

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

class Frame;

/// Froxel volumes of the local media in view: RGBA16F 3D textures, see shaders/volumetrics/media/inject_media.comp.
/// All empty without any.
struct FroxelMedia {
    /// Farthest view depth [m] seen through each column, see froxel_columns.frag: nothing is injected behind it.
    TextureRef columns;
    TextureRef scattering, extinction, emission;  ///< emission only where some local medium emits
};

/// This frame's: the first call adds the passes.
[[nodiscard]] const FroxelMedia& froxel_media(Frame& frame);
/// R32F, of the froxels' width and height.
[[nodiscard]] TextureRef add_froxel_columns(Frame& frame);

}  // namespace tyndall::volumetrics
