#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <optional>

#include "engine/core/error.h"
#include "engine/scene/data_root.h"
#include "sample_game/commands/commands.h"
#include "sample_game/flythrough.h"
#include "sample_game/game.h"
#include "sample_game/play_choice.h"
#include "sample_game/ui/loading_picture.h"
#include "session/number_option.h"

namespace tyndall {
namespace {

bool has_display() {
    const auto set = [](const char* name) {
        const char* value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

Stage parse_stage(const std::string& name) {
    if (name == "title") return Stage::title;
    if (name == "walk") return Stage::walk;
    if (name == "explore") return Stage::explore;
    throw UsageError(fmt::format("--begin {}: expected title, walk or explore", name));
}

/// The title is for who starts the sample level and asks for nothing that a title would stand before.
bool wants_title(const CLI::App& command) {
    constexpr std::array choices{"SCENE",    "--animation",  "--media",      "--add-media",
                                 "--frames", "--fixed-step", "--screenshot", "--stats"};
    return std::ranges::none_of(choices, [&](const char* option) { return command.count(option) > 0; });
}

}  // namespace

void add_play_command(CLI::App& app) {
    struct Options {
        DrawOptions draw;
        GameOptions game;
        std::optional<std::string> begin;
        std::optional<float> scale;
        std::optional<double> frame_budget;
        FlythroughOptions path{.out = "tyndall-flythrough"};
    };
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("play", "Walk through a level; with no display, render its fly-through");
    o->draw.add_to(*command, (data_root() / "assets/levels/abbey.glb").string(), "1280x720");
    command
        ->add_option("--scale", o->scale,
                     "of the sides of the picture of the scene, which is scaled up to the window; without a GPU as "
                     "small as can be walked through")
        ->check(number_in(least_scale, 1));
    command
        ->add_option("--frame-budget", o->frame_budget,
                     "ms that a frame may take: the scale follows, until it is set by hand; without a GPU 100")
        ->check(number_in(1, 10000));
    command->add_option("--begin", o->begin,
                        "title, walk or explore (title: the sample level, without options that choose what is "
                        "drawn)");
    command->add_option("--frames", o->game.frames, "quit after so many frames")->check(CLI::Range(1, 1000000000));
    command->add_option("--fixed-step", o->game.fixed_step, "seconds per frame instead of the wall clock")
        ->check(number_in(1e-4, 1));
    command->add_option("--screenshot", o->game.screenshot, "picture of the last frame, with the HUD");
    command->add_option("--stats", o->game.stats,
                        "JSON as of render, with the player; written at each F2 picture and at the end");
    command->add_option("--out", o->path.out, "without a display: folder of the fly-through")
        ->capture_default_str();
    command->add_option("--duration", o->path.duration, "without a display: seconds of the fly-through's path")
        ->check(number_in(1e-3, 1e6));
    command->callback([o, command] {
        if (!has_display() && parse_context_kind(o->draw.context) == ContextKind::automatic) {
            for (const char* option :
                 {"--begin", "--frames", "--fixed-step", "--screenshot", "--stats", "--scale", "--frame-budget"})
                if (command->count(option) > 0) throw Error(fmt::format("no display, which {} needs", option));
            fmt::print(stderr, "tyndall: no display, so the fly-through is rendered into {}\n",
                       o->path.out.string());
            if (command->count("--size") == 0) o->draw.size = "640x360";
            const auto say = [](Session&, const std::string& doing) { fmt::print(stderr, "{}\n", doing); };
            Session session(o->draw, false, say);
            if (session.context->capabilities().software) {
                if (command->count("--size") == 0) session.size = {384, 216};
                if (!o->draw.preset) {
                    o->draw.preset = "fast";
                    o->draw.apply(session.settings);
                }
                o->path.frames_per_second = 1;
                fmt::print(stderr, "no GPU, so {}x{} pixels, preset {}, {} frame a second of the path\n",
                           session.size.x, session.size.y, *o->draw.preset, o->path.frames_per_second);
            }
            o->path.lines = true;
            fly_through(session, o->path);
            fmt::print("{}\n", (o->path.out / "summary.md").string());
            return;
        }
        std::vector<NamedFile> outputs;
        if (o->game.screenshot) {
            check_picture_name("--screenshot", *o->game.screenshot);
            outputs.push_back({"--screenshot", *o->game.screenshot});
        }
        if (o->game.stats) outputs.push_back({"--stats", *o->game.stats});
        check_outputs(outputs, o->draw.inputs());
        o->game.player_path = player_settings_path();
        try {
            o->game.player = load_player_settings(o->game.player_path);
        } catch (const Error& e) {
            o->game.told = fmt::format("{}: the player's settings are the defaults\n", e.what());
        }
        const Stage unasked = wants_title(*command) ? Stage::title : Stage::explore;
        o->game.begin = o->begin ? parse_stage(*o->begin) : unasked;
        std::optional<WalkScript> script;
        const std::filesystem::path walk = walk_path(o->draw.scene);
        if (o->game.begin != Stage::explore) {
            if (!std::filesystem::exists(walk))
                throw Error(fmt::format("{}: no walk of it, {}", o->draw.scene, walk.string()));
            script = load_walk(walk);
        }
        const auto furnish = [&](Scene& scene) {
            if (script) o->game.walk.emplace(*script, scene, walk.string());
        };
        std::optional<LoadingPicture> picture;
        float share = 0;
        const auto choose = [&](Session& opening) {
            PlayGiven given{
                .window = {}, .scale = o->scale, .frame_budget = o->frame_budget, .preset = o->draw.preset};
            if (command->count("--size") > 0) given.window = o->draw.pixels();
            const std::string kept = preset_of(o->game.player.quality);
            if (!given.preset && !kept.empty()) given.preset = kept;
            const PlayChoice choice = choose_play(opening.context->capabilities().renderer, given);
            o->draw.preset = choice.preset;
            opening.settings.set("scattering_orders=4");  // players see white clouds
            o->draw.apply(opening.settings);
            o->game.scale = choice.scale;
            o->game.frame_budget = choice.frame_budget;
            o->game.told += choice.told;
            opening.context->show_window(choice.window);
        };
        const auto show = [&](Session& opening, const std::string& doing) {
            if (!picture) {
                choose(opening);
                picture.emplace(*opening.context, *opening.shaders);
            }
            picture->show(doing, share += 0.25f);
        };
        Session session(o->draw, true, show, furnish);
        o->game.early_keys = picture->keys_pressed();
        picture.reset();  // what it has shown stays until the first frame
        play(session, o->game);
    });
}

}  // namespace tyndall
