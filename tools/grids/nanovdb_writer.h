#pragma once

#include <string>

#include "tools/grids/voxels.h"

namespace tyndall::grid_models {

/// The bytes of a .nvdb file with a fog volume "density", values in 8 bits of each leaf's range, packed with zip.
/// The same voxels give the same bytes.
[[nodiscard]] std::string to_nanovdb(const Voxels& voxels);

}  // namespace tyndall::grid_models
