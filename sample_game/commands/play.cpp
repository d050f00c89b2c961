#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "engine/core/files.h"
#include "sample_game/commands/commands.h"
#include "sample_game/flythrough.h"
#include "sample_game/game.h"

namespace tyndall {
namespace {

bool has_display() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

}  // namespace

void add_play_command(CLI::App& app) {
    struct Options {
        DrawOptions draw;
        GameOptions game;
        FlythroughOptions path{.out = "tyndall-flythrough"};
    };
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("play", "Walk through a level; with no display, render its fly-through");
    o->draw.add_to(*command, (data_root() / "assets/levels/abbey.glb").string(), "1280x720");
    command->add_option("--frames", o->game.frames, "quit after so many frames")->check(CLI::PositiveNumber);
    command->add_option("--fixed-step", o->game.fixed_step, "seconds per frame instead of the wall clock")
        ->check(CLI::Range(1e-4, 1.0));
    command->add_option("--screenshot", o->game.screenshot, "picture of the last frame, with the HUD");
    command->add_option("--stats", o->game.stats,
                        "JSON as of render, with the player; written at each F2 picture and at the end");
    command->add_option("--out", o->path.out, "without a display: folder of the fly-through")
        ->capture_default_str();
    command->add_option("--duration", o->path.duration, "without a display: seconds of the fly-through's path")
        ->check(CLI::PositiveNumber);
    command->callback([o, command] {
        if (!has_display() && parse_context_kind(o->draw.context) == ContextKind::automatic) {
            fmt::print(stderr, "tyndall: no display, so the fly-through is rendered into {}\n",
                       o->path.out.string());
            if (command->count("--size") == 0) o->draw.size = "640x360";
            Session session(o->draw, false);
            fly_through(session, o->path);
            fmt::print("{}\n", (o->path.out / "summary.md").string());
            return;
        }
        Session session(o->draw, true);
        play(session, o->game);
    });
}

}  // namespace tyndall
