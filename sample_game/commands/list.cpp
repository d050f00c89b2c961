#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "engine/core/error.h"
#include "engine/scene/data_root.h"
#include "sample_game/commands/commands.h"
#include "session/session.h"
#include "volumetrics/technique.h"

namespace tyndall {
namespace {

std::string range_text(const Setting& s) {
    switch (s.type) {
        case SettingType::boolean:
            return "true, false";
        case SettingType::choice:
            return fmt::format("{}", fmt::join(s.choices, ", "));
        case SettingType::integer:
            if (!s.allowed.empty()) return fmt::format("{}", fmt::join(s.allowed, ", "));
            [[fallthrough]];
        case SettingType::real:
            return fmt::format("{} … {}", s.min, s.max);
    }
    return {};
}

void list_settings(bool markdown) {
    volumetrics::Settings volumetrics_settings;
    RenderSettings render_settings;
    SettingsSet set;
    set.add(volumetrics::settings_table(), &volumetrics_settings);
    set.add(render_settings_table(), &render_settings);
    for (const SettingsSet::Group& group : set.groups()) {
        if (markdown)
            fmt::print("## {}\n\n| key | default | range | unit | what it does |\n|---|---|---|---|---|\n",
                       group.table->title());
        for (const Setting& s : group.table->settings()) {
            const std::string value = set.get(s.key);
            if (markdown)
                fmt::print("| `{}` | {} | {} | {} | {} |\n", s.key, value, range_text(s), s.unit, s.help);
            else
                fmt::print("{:<24}{:<18}[{}] {}\n    {}\n", s.key, value, range_text(s), s.unit, s.help);
        }
        if (markdown) fmt::print("\n");
    }
}

void list_scenes() {
    std::vector<std::string> names;
    for (const char* folder : {"assets/levels", "assets/bench"})
        for (const auto& entry : std::filesystem::directory_iterator(data_root() / folder))
            if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
                names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    fmt::print("{}\n", fmt::join(names, "\n"));
}

void list_cameras(const std::string& path) {
    const Scene scene = load_gltf(path);
    for (const Camera& camera : scene.cameras) fmt::print("{}\n", camera.name);
}

}  // namespace

void add_list_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("list", "What there is to choose from");
    command->require_subcommand(1);
    command->add_subcommand("techniques")->callback([] {
        fmt::print("{}\n", fmt::join(volumetrics::technique_names(), "\n"));
    });
    command->add_subcommand("presets")->callback([] { fmt::print("{}\n", fmt::join(preset_names(), "\n")); });
    command->add_subcommand("scenes")->callback(list_scenes);
    auto markdown = std::make_shared<bool>(false);
    CLI::App* settings = command->add_subcommand("settings");
    settings->add_flag("--markdown", *markdown, "as the tables of docs/settings.md");
    settings->callback([markdown] { list_settings(*markdown); });
    auto scene = std::make_shared<std::string>();
    CLI::App* cameras = command->add_subcommand("cameras");
    cameras->add_option("SCENE", *scene)->required();
    cameras->callback([scene] { list_cameras(*scene); });
}

}  // namespace tyndall
