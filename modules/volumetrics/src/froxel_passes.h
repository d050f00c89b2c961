#pragma once

#include "passes.h"

namespace tyndall::volumetrics {

/// The steps of the technique froxel after add_inject_media, see the shaders of the same names. All textures of
/// `AccumulatedFroxels` and `radiance` are RGBA16F volumes of the froxels' size, `columns` is R32F of its width and
/// height.
struct AccumulatedFroxels {
    TextureRef radiance;       ///< rgb light up to the end of each slice, a mean optical depth of the local media
    TextureRef optical_depth;  ///< that of each channel, where there are local media and coloured extinction
};

/// Farthest view depth [m] seen through each column.
[[nodiscard]] TextureRef add_froxel_columns(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                            const Settings& settings);
/// Light of each slice, attenuated by the global media before it.
[[nodiscard]] TextureRef add_froxel_light(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                          const Settings& settings, const FrameMedia& media,
                                          const FroxelMedia& froxels, TextureRef columns);
[[nodiscard]] AccumulatedFroxels add_froxel_accumulate(PassList& passes, const PassResources& resources,
                                                       const Inputs& inputs, const Settings& settings,
                                                       const FrameMedia& media, const FroxelMedia& froxels,
                                                       TextureRef columns, TextureRef radiance);
[[nodiscard]] Outputs add_froxel_apply(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                       const FrameMedia& media, TextureRef columns,
                                       const AccumulatedFroxels& froxels);

/// Value of the axis HEIGHT_MEDIA.
[[nodiscard]] int height_media_axis(const FrameMedia& media);

}  // namespace tyndall::volumetrics
