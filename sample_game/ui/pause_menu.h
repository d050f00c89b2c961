#pragma once

#include <string>
#include <vector>

#include "sample_game/ui/menu.h"
#include "sample_game/ui/player_rows.h"

namespace tyndall {

/// What stands over the picture while the game waits. Within a Dear ImGui frame. `to_title`: there is one.
[[nodiscard]] MenuRequests pause_menu(PlayerSettings& settings, PlayerRows& rows, const Input& input,
                                      const std::vector<std::string>& places, bool to_title);

}  // namespace tyndall
