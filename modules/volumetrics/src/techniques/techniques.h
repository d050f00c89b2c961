#pragma once

#include "volumetrics/technique.h"

namespace tyndall::volumetrics {

// The rows of techniques.cpp, each in a file of its name.
[[nodiscard]] TechniqueDesc ray_march();
[[nodiscard]] TechniqueDesc froxel();
[[nodiscard]] TechniqueDesc billboards();
[[nodiscard]] TechniqueDesc particles();
[[nodiscard]] TechniqueDesc shaft_geometry();
[[nodiscard]] TechniqueDesc analytic_fog();
[[nodiscard]] TechniqueDesc radial_shafts();
[[nodiscard]] TechniqueDesc epipolar();
[[nodiscard]] TechniqueDesc automatic();
[[nodiscard]] TechniqueDesc reference();

}  // namespace tyndall::volumetrics
