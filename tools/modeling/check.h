#pragma once

#include <string>
#include <vector>

#include "tools/modeling/scene.h"

namespace tyndall::modeling {

// One line for each vertex group that is not finite and each rotation that is not of unit length; empty: all is
// well.
std::vector<std::string> check_scene(const Scene& scene);

}  // namespace tyndall::modeling
