#pragma once

#include "engine/core/image.h"
#include "engine/render/frame_context.h"

namespace tyndall {

/// The layer acceptance, of any resolution, as colours of a frame: from red (nothing of earlier frames) to green.
[[nodiscard]] Image acceptance_picture(const Image& shares, glm::ivec2 size);

/// Adds the pass "acceptance_view", in the place of the tonemap: the same picture over the whole of `display`
/// (RGBA8), whose new version it returns.
[[nodiscard]] TextureRef add_acceptance_view(FrameContext& frame, TextureRef acceptance, TextureRef display);

}  // namespace tyndall
