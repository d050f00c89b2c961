#pragma once

#include <filesystem>
#include <string>

#include "engine/grids/grid_sink.h"

namespace tyndall::grids {

/// The grid `name` of a NanoVDB file: float, or quantised to 4, 8, 16 or a varying number of bits. Run it isolated:
/// offsets are checked here, but memory and time are not.
void read_nanovdb(const std::filesystem::path& file, const std::string& name, GridSink& sink);

}  // namespace tyndall::grids
