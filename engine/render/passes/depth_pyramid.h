#pragma once

#include "engine/render/frame_context.h"

namespace tyndall {

/// Adds the pass that builds a mip chain of the farthest depth (R32F, level 0 at half the size of `depth`; see
/// shaders/engine/depth_pyramid.comp for which texel covers which pixel).
[[nodiscard]] TextureRef add_depth_pyramid(FrameContext& frame, TextureRef depth);

}  // namespace tyndall
