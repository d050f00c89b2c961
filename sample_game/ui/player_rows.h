#pragma once

#include <string>

#include "engine/platform/input.h"
#include "sample_game/player_settings.h"

namespace tyndall {

/// The rows of what a player sets, his keys in a section that folds: for every menu. Within a Dear ImGui frame.
class PlayerRows {
  public:
    void frame(PlayerSettings& settings, const Input& input, float width);
    /// The next key that is pressed becomes that of a row, and is nothing else.
    [[nodiscard]] bool waits_for_key() const { return waiting_ != nullptr; }
    void close();  ///< the menu is gone

  private:
    void keys(KeyBindings& keys, const Input& input);
    void take(KeyBindings& keys, const Input& input);

    const Setting* waiting_ = nullptr;
    std::string problem_;
};

}  // namespace tyndall
