#pragma once

#include <string>

#include "tools/modeling/scene.h"

namespace tyndall::modeling {

// The scene as the bytes of a binary glTF 2.0 file. The same scene gives the same bytes.
std::string to_glb(const Scene& scene, const MaterialSet& materials, const std::string& generator);

}  // namespace tyndall::modeling
