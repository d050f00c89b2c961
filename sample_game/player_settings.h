#pragma once

#include <filesystem>
#include <string>

#include "engine/core/settings.h"
#include "sample_game/key_bindings.h"

namespace tyndall {

/// as_started: what the command line and the driver asked for.
enum class Quality { as_started, fast, balanced, quality };

/// What a player sets once, kept between starts.
struct PlayerSettings {
    float field_of_view = 60;  ///< degrees, vertical
    float look_speed = 1;      ///< of pointer, stick and arrow keys
    bool invert_look = false;
    bool full_screen = false;
    Quality quality = Quality::as_started;
    KeyBindings keys;
    bool operator==(const PlayerSettings&) const = default;
};
[[nodiscard]] const SettingsTable& player_settings_table();  ///< all but the keys
/// Name of the preset; empty: none.
[[nodiscard]] std::string preset_of(Quality quality);

/// $XDG_CONFIG_HOME/tyndall/player.json, or ~/.config/…
[[nodiscard]] std::filesystem::path player_settings_path();
/// Defaults where there is no file. Throws Error when it is there and cannot be used.
[[nodiscard]] PlayerSettings load_player_settings(const std::filesystem::path& path);
/// Throws Error.
void save_player_settings(const std::filesystem::path& path, const PlayerSettings& settings);

}  // namespace tyndall
