#pragma once

#include "engine/core/image.h"
#include "engine/gl/texture.h"

namespace tyndall::gl {

/// Reads level 0 of a 2D texture, or one layer/slice, as float, flipped so that row 0 is the top. Depth textures
/// give one channel. Waits for the GPU.
[[nodiscard]] Image read_texture(const TextureView& texture, int layer = 0);

}  // namespace tyndall::gl
