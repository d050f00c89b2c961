#pragma once

#include <filesystem>
#include <string>

#include "engine/grids/grid_sink.h"

namespace tyndall::grids {

/// The grid `name` of an OpenVDB file. Run it isolated: damaged files make OpenVDB crash, or never end.
void read_vdb(const std::filesystem::path& file, const std::string& name, GridSink& sink);

}  // namespace tyndall::grids
