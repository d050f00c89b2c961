#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/image.h"

namespace tyndall {

/// Decodes a PNG file with libpng itself: read through OpenImageIO, libpng would print about damaged and odd files
/// to stderr. Values are 0..1 as stored, palettes become colours, and the channels are grey, grey and alpha, RGB or
/// RGBA. Throws Error, which begins with `name`; a side of more than `max_side` pixels is one.
[[nodiscard]] Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name, int max_side);

}  // namespace tyndall
