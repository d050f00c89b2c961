#pragma once

#include "frame/resources.h"
#include "volumetrics/outputs.h"

namespace tyndall::volumetrics {

/// See Volumetrics::composite.
[[nodiscard]] TextureRef add_composite(PassList& passes, ShaderLibrary& shaders, const Resources& resources,
                                       const Outputs& outputs, TextureRef color, bool count_work);

}  // namespace tyndall::volumetrics
