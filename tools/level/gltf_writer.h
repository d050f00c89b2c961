#pragma once

#include <string>

#include "tools/level/level.h"

namespace tyndall::level {

// The level as the bytes of a binary glTF 2.0 file. The same level gives the same bytes.
std::string to_glb(const Level& level, const MaterialSet& materials);

}  // namespace tyndall::level
