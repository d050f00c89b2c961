// Windows of coloured glass with lead between the pieces, for openings of walls.
#pragma once

#include "tools/level/level.h"
#include "tools/level/wall.h"

namespace tyndall::level {

enum class StainedGlass { Ruby, Cobalt, Emerald, Amber };

// Fills an opening in the middle of its wall, each of `lights` of equal width with a pane.
Mesh stained_window(const std::string& name, const Wall& wall, const Opening& opening,
                    std::span<const StainedGlass> lights);
// An instance by itself, so that windows are sorted one by one.
void add_stained_window(Level& level, int mesh, vec3 position, float yaw_degrees);

}  // namespace tyndall::level
