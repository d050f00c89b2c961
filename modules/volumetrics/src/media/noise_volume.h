#pragma once

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

class Frame;

/// What noise makes of the local media along each column of froxels: RG32F, a layer more than the froxels have
/// slices; see shaders/volumetrics/media/noise_volume.comp. Empty where no medium has noise. The first call adds
/// the pass.
[[nodiscard]] TextureRef noise_volume(Frame& frame);

}  // namespace tyndall::volumetrics
