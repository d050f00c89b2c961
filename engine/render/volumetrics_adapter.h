#pragma once

#include "engine/render/frame_context.h"
#include "engine/render/light_set.h"
#include "engine/render/passes/lighting.h"
#include "volumetrics/inputs.h"

namespace tyndall {

/// The frame in the volumetrics module's terms: view and media. Local media out of view are given too: they may
/// dim the light of what is in view.
[[nodiscard]] volumetrics::Inputs volumetrics_inputs(const FrameContext& frame);

/// Adds what the passes before made: the depth and the lights.
void add_lighting_inputs(volumetrics::Inputs& inputs, const LightSources& sources, const LightSet& lights,
                         TextureRef depth);

}  // namespace tyndall
