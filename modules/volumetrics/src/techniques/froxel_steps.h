#pragma once

#include "media/froxel_media.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

class FroxelHistory;

// The steps of froxel_fog.h, see the shaders of the same names. All textures are RGBA16F volumes of the froxels'
// size; `columns`: froxel_columns().

/// Of which light froxels hold: all; or of the lamps that are not among FrameMedia::few_lamps.
enum class FroxelContent { all, many_lamps };
/// Name of the pass of a step: a frame may have both, for transparents are fogged by all light.
[[nodiscard]] inline std::string froxel_pass(const char* step, FroxelContent content) {
    return (content == FroxelContent::all ? "volumetrics/froxel_" : "volumetrics/many_lamps_") + std::string(step);
}

/// Without a history only `radiance`.
struct FroxelLight {
    TextureRef radiance;  ///< light of each slice; with a history without sun and lamps, which froxel_history adds
    /// rgb visible share of the lamps' light, a of the sun, in this frame; < 0: there are none.
    TextureRef visibility;
    TextureRef sun, lamps;  ///< unshadowed light
    FroxelContent content = FroxelContent::all;
};
/// Attenuated by the global media before it.
[[nodiscard]] FroxelLight add_froxel_light(Frame& frame, const FroxelMedia& media, TextureRef columns,
                                           const FroxelHistory* history, FroxelContent content);

/// Averages the visibility over the frames; returns the radiance with the light of sun and lamps.
[[nodiscard]] TextureRef add_froxel_history(Frame& frame, TextureRef columns, const FroxelLight& light,
                                            FroxelHistory& history);

/// Sums up along each column. Fog::radiance: rgb light up to the end of each slice, a mean optical depth of the
/// local media; Fog::optical_depth that of each channel, where there are local media and coloured extinction.
[[nodiscard]] Fog add_froxel_accumulate(Frame& frame, const FroxelMedia& media, TextureRef columns,
                                        TextureRef radiance, FroxelContent content);

}  // namespace tyndall::volumetrics
