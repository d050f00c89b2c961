#pragma once

#include <string>
#include <vector>

#include "tools/level/level.h"

namespace tyndall::level {

// What a level must keep to, one line for each thing that is wrong; empty: all is well. `report` gets figures worth
// knowing.
std::vector<std::string> check_level(const Level& level, const MaterialSet& materials, size_t file_bytes,
                                     std::string& report);

}  // namespace tyndall::level
