#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/image.h"
#include "engine/core/image_encode.h"
#include "engine/core/output_files.h"
#include "sample_game/commands/commands.h"
#include "sample_game/stats_json.h"
#include "session/number_option.h"
#include "session/session.h"

namespace tyndall {
namespace {

struct RenderOptions {
    DrawOptions draw;
    ViewOptions view;
    std::string output;
    std::optional<std::string> stats;
    int frames = 1;
    double frame_time = 0;  ///< s between frames
    std::string layer = "color";
};

void run(const RenderOptions& o) {
    check_picture_name("--output", o.output);
    std::vector<NamedFile> outputs{{"--output", o.output}};
    if (o.stats) outputs.push_back({"--stats", *o.stats});
    check_outputs(outputs, o.draw.inputs());
    o.view.check();

    Session session(o.draw, false);
    session.options.layer = o.layer;
    session.options.count_work = o.stats.has_value();
    const double last = o.view.time.value_or((o.frames - 1) * o.frame_time);
    for (int left = o.frames - 1; left >= 0; --left) {
        if (o.stats && left == 0) session.timer->set_mode(session.timer_mode());
        const double time = last - left * o.frame_time;
        animate(session.scene, time);
        session.draw(o.view.view(session.scene, session.size), time);
    }
    const bool display = o.output.ends_with(".png") && o.layer == "color";
    OutputFiles files;
    files.add(o.output,
              encode_image(o.output, display ? session.renderer->read_display() : session.renderer->read_layer()));
    if (o.stats) files.add(*o.stats, stats_json(session).dump(2) + "\n");
    files.commit();
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto o = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "One picture: PNG as a player sees it, EXR linear radiance");
    o->draw.add_to(*command, "", "1280x720");
    command->add_option("-o,--output", o->output, "OUT.png or OUT.exr")->required();
    o->view.add_to(*command);
    command->add_option("--frames", o->frames, "frames drawn before the picture is taken")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command
        ->add_option("--frame-time", o->frame_time,
                     "seconds from frame to frame, of which the last is at --time, or without it the first at 0; "
                     "0: nothing moves")
        ->check(number_in(0, 10))
        ->capture_default_str();
    command->add_option("--layer", o->layer, "what to write")
        ->check(CLI::IsMember(Session::layer_names()))
        ->capture_default_str();
    command->add_option("--stats", o->stats, "JSON with passes, times, work counts, memory and driver");
    command->callback([o] { run(*o); });
}

}  // namespace tyndall
