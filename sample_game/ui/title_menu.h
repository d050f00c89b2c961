#pragma once

#include "sample_game/ui/menu.h"
#include "sample_game/ui/player_rows.h"

namespace tyndall {

/// What the game begins with. Within a Dear ImGui frame.
class TitleMenu {
  public:
    [[nodiscard]] MenuRequests frame(const std::string& words, PlayerSettings& settings, PlayerRows& rows,
                                     const Input& input);

  private:
    MenuRequests choices(PlayerRows& rows);
    bool settings_ = false;  ///< they are shown
};

}  // namespace tyndall
