#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sample_game/player_settings.h"

namespace tyndall {

/// What stands over the picture while the game waits: for pointer, keyboard and gamepad. Within a Dear ImGui frame.
struct PauseMenuRequests {
    bool go_on = false, quit = false, debug_ui = false;
    std::optional<std::string> place;
};
[[nodiscard]] PauseMenuRequests pause_menu(PlayerSettings& settings, const std::vector<std::string>& places);

}  // namespace tyndall
