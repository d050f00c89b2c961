#pragma once

#include "tools/level/materials.h"
#include "tools/modeling/scene.h"

namespace tyndall::level {

using Level = Scene;

// The whole sample level.
Level build_level();

// Sun: the unit direction towards it.
vec3 to_sun();

}  // namespace tyndall::level
