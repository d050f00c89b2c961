#pragma once

#include <bitset>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/platform/input.h"

namespace tyndall {

/// Hands the game's input to Dear ImGui, whose context must exist.
class ImguiInput {
  public:
    ImguiInput();  ///< tells Dear ImGui which keys are where
    /// One frame's input. `size` in pixels, `dt` in seconds. `pointer_is_free`: not captured for mouse look.
    void feed(const Input& input, glm::ivec2 size, double dt, bool pointer_is_free);

  private:
    std::bitset<static_cast<int>(MouseButton::count)>
        late_;                                        ///< pressed as the pointer arrived: told a frame later
    std::optional<Input::Modifiers> late_modifiers_;  ///< of that press
};

}  // namespace tyndall
