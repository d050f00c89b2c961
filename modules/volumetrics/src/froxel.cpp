#include "froxel_passes.h"

namespace tyndall::volumetrics {

Outputs add_froxel(PassList& passes, const PassResources& resources, const Inputs& inputs, const Settings& settings,
                   const FrameMedia& media, const FroxelMedia& froxels) {
    const TextureRef columns = add_froxel_columns(passes, resources, inputs, settings);
    const TextureRef light = add_froxel_light(passes, resources, inputs, settings, media, froxels, columns);
    const AccumulatedFroxels accumulated =
        add_froxel_accumulate(passes, resources, inputs, settings, media, froxels, columns, light);
    return add_froxel_apply(passes, resources, inputs, media, columns, accumulated);
}

}  // namespace tyndall::volumetrics
