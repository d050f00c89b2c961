#pragma once

#include <glm/vec2.hpp>

#include "engine/platform/input.h"

namespace tyndall {

/// Tells Dear ImGui which keys are where; once, after its context was made.
void map_imgui_keys();
/// Hands one frame's input to Dear ImGui. `size` in pixels, `dt` in seconds.
void feed_imgui(const Input& input, glm::ivec2 size, double dt, bool pointer_is_free);

}  // namespace tyndall
