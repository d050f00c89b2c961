#pragma once

#include "engine/render/frame_context.h"
#include "engine/render/passes/lighting.h"
#include "volumetrics/inputs.h"

namespace tyndall {

/// The frame in the volumetrics module's terms: view and media. Media that are out of view (facts) are left out.
[[nodiscard]] volumetrics::Inputs volumetrics_inputs(const FrameContext& frame);

/// Adds what the passes before made: the depth and the lights.
void add_lighting_inputs(volumetrics::Inputs& inputs, const LightSources& sources, TextureRef depth);

}  // namespace tyndall
