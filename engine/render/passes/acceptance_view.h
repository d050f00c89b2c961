#pragma once

#include "engine/render/frame_context.h"

namespace tyndall {

/// Adds the pass "acceptance_view", in the place of the tonemap: the layer acceptance, from red to green, over the
/// whole of `display` (RGBA8), whose new version it returns. `acceptance`: volumetrics::Outputs, of any resolution.
[[nodiscard]] TextureRef add_acceptance_view(FrameContext& frame, TextureRef acceptance, TextureRef display);

}  // namespace tyndall
