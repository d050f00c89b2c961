#pragma once

#include <string>
#include <vector>

#include "sample_game/ui/menu.h"
#include "sample_game/ui/player_rows.h"

namespace tyndall {

/// What stands over the picture while the game waits. Within a Dear ImGui frame.
[[nodiscard]] MenuRequests pause_menu(PlayerSettings& settings, PlayerRows& rows, const Input& input,
                                      const std::vector<std::string>& places);

}  // namespace tyndall
