#include <fmt/format.h>

#include <memory>

#include "engine/scene/scene_doubts.h"
#include "engine/scene/scene_report.h"
#include "sample_game/commands/commands.h"
#include "volumetrics/settings.h"

namespace tyndall {
namespace {

void inspect(const std::string& path) {
    GltfNotes notes;
    const Scene scene = load_gltf(path, notes);
    const float far_end = volumetrics::Settings{}.march.max_distance;
    fmt::print("{}", report(scene, notes, likely_mistakes(scene, notes, far_end)));
}

}  // namespace

void add_inspect_command(CLI::App& app) {
    auto scene = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "inspect", "What is in a scene, what of it is left out and why, and what looks like a mistake");
    command->add_option("SCENE", *scene, "a glTF scene (.glb or .gltf)")->required();
    command->callback([scene] { inspect(*scene); });
}

}  // namespace tyndall
