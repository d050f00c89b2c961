#pragma once

#include "techniques/froxel_steps.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

class FroxelHistory;

/// Light and transmittance of froxels: the technique froxel but for its last step, and what transparents are fogged
/// by whatever the technique. `columns`: froxel_columns() or transparent_columns(). `history` is null where there
/// is none.
[[nodiscard]] Fog add_froxel_fog(Frame& frame, TextureRef columns, FroxelHistory* history,
                                 FroxelContent content = FroxelContent::all);
/// The technique froxel.
[[nodiscard]] Estimate add_froxel(Frame& frame);
/// At the texture units of shaders/volumetrics/frame/apply.glsl.
void bind_fog_textures(const PassContext& context, const Fog& fog);

}  // namespace tyndall::volumetrics
