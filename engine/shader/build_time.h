#pragma once

namespace tyndall {

/// What this process has spent on reading, compiling and linking programs. Drivers may compile more at the first
/// draw.
[[nodiscard]] double seconds_building_shaders();

}  // namespace tyndall
