#include "sample_game/flythrough.h"

#include <fmt/format.h>

#include <memory>

#include "sample_game/commands/commands.h"
#include "session/number_option.h"

namespace tyndall {

void add_flythrough_command(CLI::App& app) {
    struct Options {
        DrawOptions draw;
        FlythroughOptions path;
    };
    auto o = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("flythrough", "The camera path of a level: times per frame and pass, a still per place");
    o->draw.add_to(*command, "", "640x360");
    command->add_option("--out", o->path.out, "folder for the tables and stills")->required();
    command->add_option("--frames-per-second", o->path.frames_per_second, "fixed time steps along the path")
        ->check(number_in(0.1, 240))
        ->capture_default_str();
    command->add_option("--duration", o->path.duration, "seconds of the path (default: all)")
        ->check(number_in(1e-3, 1e6));
    command->callback([o] {
        Session session(o->draw, false);
        fly_through(session, o->path);
        fmt::print("{}\n", (o->path.out / "summary.md").string());
    });
}

}  // namespace tyndall
