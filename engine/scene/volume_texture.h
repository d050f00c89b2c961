#pragma once

#include <filesystem>

#include "engine/grids/grid_sink.h"

namespace tyndall {

/// A dense volume from its header, {"image": "x.raw", "size": [x, y, z], "type": "u8", "voxel_size": 0.1,
/// "origin": [0, 0, 0]}. The image lies in the header's folder: raw numbers (u8, u16, f16, f32; little-endian, x
/// fastest, then y, then z), or the slices of z as a strip in a .png or .exr, one below the other, each with y = 0
/// as its top row; the first channel counts, integers become 0..1. `origin` is the box's lowest corner, m. Throws
/// Error of one line that starts with the header's path.
void read_volume_texture(const std::filesystem::path& header, grids::GridSink& sink);

}  // namespace tyndall
