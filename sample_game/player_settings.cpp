#include "sample_game/player_settings.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall {
namespace fs = std::filesystem;

const SettingsTable& player_settings_table() {
    using S = PlayerSettings;
    static const SettingsTable table =
        SettingsTable("Player")
            .real(&S::field_of_view,
                  {"field_of_view", "Field of view", "Height of what one sees, as an angle.", "degrees"}, 40, 100)
            .real(&S::look_speed,
                  {"look_speed", "Look speed", "How fast pointer, right stick and arrow keys turn the view."}, 0.2,
                  5, SettingScale::logarithmic)
            .boolean(&S::invert_look, {"invert_look", "Invert look", "Forward and down look up."},
                     SettingEffect::uniform)
            .boolean(&S::full_screen, {"full_screen", "Full screen", "The window fills the monitor."},
                     SettingEffect::resource)
            .choice(&S::quality,
                    {"quality", "Quality", "A preset of all graphics settings; as_started changes none of them."},
                    {"as_started", "fast", "balanced", "quality"}, SettingEffect::permutation);
    return table;
}

std::string preset_of(Quality quality) {
    return quality == Quality::as_started
               ? std::string()
               : player_settings_table().settings().back().choices.at(static_cast<std::size_t>(quality));
}

fs::path player_settings_path() {
    const auto folder = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value == nullptr ? "" : value);
    };
    const fs::path own = folder("XDG_CONFIG_HOME");
    return (own.is_absolute() ? own : folder("HOME") / ".config") / "tyndall/player.json";
}

PlayerSettings load_player_settings(const fs::path& path) {
    PlayerSettings settings;
    if (!fs::exists(path)) return settings;
    SettingsSet set;
    set.add(player_settings_table(), &settings);
    set.add(key_bindings_table(), &settings.keys);
    set.from_json(read_json(path), path.string());
    if (const std::string problem = problem_of(settings.keys); !problem.empty())
        throw Error(fmt::format("{}: {}", path.string(), problem));
    return settings;
}

void save_player_settings(const fs::path& path, const PlayerSettings& settings) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) throw Error(fmt::format("{}: {}", path.parent_path().string(), error.message()));
    PlayerSettings copy = settings;
    SettingsSet set;
    set.add(player_settings_table(), &copy);
    set.add(key_bindings_table(), &copy.keys);
    write_text(path, set.to_json().dump(2) + "\n");
}

}  // namespace tyndall
