#include "techniques/froxel_history.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {

Fog add_froxel_fog(PassList& passes, const PassResources& resources, const Inputs& inputs, const Settings& settings,
                   const FrameMedia& media, const FroxelMedia& froxels, FroxelHistory& history) {
    const TextureRef columns =
        froxels.columns ? froxels.columns : add_froxel_columns(passes, resources, inputs, settings);
    const bool keeps = keeps_history(inputs, settings, media);
    if (keeps) history.begin_frame(inputs, settings, media);
    const FroxelLight light =
        add_froxel_light(passes, resources, inputs, settings, media, froxels, columns, keeps ? &history : nullptr);
    TextureRef radiance = light.radiance;
    if (keeps)
        radiance = add_froxel_history(passes, resources, inputs, settings, columns, light, history);
    else
        passes.skip("volumetrics/froxel_history",
                    settings.froxel_history > 0 ? "neither sun nor lamps" : "froxel_history is 0");
    const AccumulatedFroxels accumulated =
        add_froxel_accumulate(passes, resources, inputs, settings, media, froxels, columns, radiance);
    return {.columns = columns, .radiance = accumulated.radiance, .optical_depth = accumulated.optical_depth};
}

Outputs add_froxel(PassList& passes, const PassResources& resources, const Inputs& inputs, const Inputs& low,
                   const Settings& settings, const FrameMedia& media, const FroxelMedia& froxels,
                   FroxelHistory& history) {
    const Fog fog = add_froxel_fog(passes, resources, inputs, settings, media, froxels, history);
    Outputs outputs = add_froxel_apply(passes, resources, low, media, fog);
    outputs.fog = fog;
    return outputs;
}

}  // namespace tyndall::volumetrics
