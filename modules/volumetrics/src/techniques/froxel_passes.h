#pragma once

#include "frame/passes.h"

namespace tyndall::volumetrics {

class FroxelHistory;

/// What froxel_light gives, RGBA16F volumes of the froxels' size. Without a history only `radiance`.
struct FroxelLight {
    TextureRef radiance;  ///< light of each slice; with a history without sun and lamps, which froxel_history adds
    /// rgb visible share of the lamps' light, a of the sun, in this frame; < 0: there are none.
    TextureRef visibility;
    TextureRef sun, lamps;  ///< unshadowed light
};

/// The steps of the technique froxel after add_inject_media, see the shaders of the same names. All textures of
/// `AccumulatedFroxels` and `radiance` are RGBA16F volumes of the froxels' size, `columns` is R32F of its width and
/// height.
struct AccumulatedFroxels {
    TextureRef radiance;       ///< rgb light up to the end of each slice, a mean optical depth of the local media
    TextureRef optical_depth;  ///< that of each channel, where there are local media and coloured extinction
};

/// At the texture units of shaders/volumetrics/frame/apply.glsl.
void bind_fog_textures(const PassContext& context, const Fog& fog);

/// Farthest view depth [m] seen through each column.
[[nodiscard]] TextureRef add_froxel_columns(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                            const Settings& settings);
/// Light of each slice, attenuated by the global media before it. `history` is null where there is none.
[[nodiscard]] FroxelLight add_froxel_light(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                           const Settings& settings, const FrameMedia& media,
                                           const FroxelMedia& froxels, TextureRef columns,
                                           const FroxelHistory* history);
/// Averages the visibility over the frames; returns the radiance with the light of sun and lamps.
[[nodiscard]] TextureRef add_froxel_history(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                            const Settings& settings, TextureRef columns, const FroxelLight& light,
                                            FroxelHistory& history);
[[nodiscard]] AccumulatedFroxels add_froxel_accumulate(PassList& passes, const PassResources& resources,
                                                       const Inputs& inputs, const Settings& settings,
                                                       const FrameMedia& media, const FroxelMedia& froxels,
                                                       TextureRef columns, TextureRef radiance);
[[nodiscard]] Outputs add_froxel_apply(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                       const FrameMedia& media, const Fog& fog);

}  // namespace tyndall::volumetrics
