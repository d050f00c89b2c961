#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image.h"
#include "sample_game/commands/commands.h"
#include "sample_game/session.h"
#include "sample_game/stats_json.h"

namespace tyndall {
namespace {

struct Options {
    DrawOptions draw;
    std::string output;
    std::optional<std::string> camera, stats;
    std::vector<float> eye, look;
    float fov = 60;
    int frames = 1;
    double time = 0;
    std::string layer = "color";
};

constexpr float default_znear = 0.1f;

View make_view(const Options& o, const Scene& scene, float aspect) {
    if (!o.eye.empty())
        return look_at({o.eye[0], o.eye[1], o.eye[2]}, {o.look[0], o.look[1], o.look[2]}, glm::radians(o.fov),
                       default_znear, aspect);
    return camera_view(scene, o.camera.value_or(scene.cameras.front().name), aspect);
}

void run(const Options& o) {
    const std::string extension = std::filesystem::path(o.output).extension().string();
    if (extension != ".png" && extension != ".exr")
        throw UsageError(fmt::format("--output {}: expected a name ending in .png or .exr", o.output));
    if (o.eye.empty() != o.look.empty()) throw UsageError("--eye and --look go together");
    if (!o.eye.empty() && o.camera) throw UsageError("--camera and --eye exclude each other");

    Session session(o.draw, false);
    session.options.layer = o.layer;
    session.options.count_work = o.stats.has_value();
    animate(session.scene, o.time);
    const float aspect = static_cast<float>(session.size.x) / static_cast<float>(session.size.y);
    const View view = make_view(o, session.scene, aspect);
    for (int i = 0; i < o.frames; ++i) {
        if (o.stats && i == o.frames - 1) session.timer->set_mode(session.timer_mode());
        session.draw(view, o.time);
    }
    const bool display = extension == ".png" && o.layer == "color";
    write_image(o.output, display ? session.renderer->read_display() : session.renderer->read_layer());
    if (o.stats) write_text(*o.stats, stats_json(session).dump(2) + "\n");
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "One picture: PNG as a player sees it, EXR linear radiance");
    o->draw.add_to(*command, "", "1280x720");
    command->add_option("-o,--output", o->output, "OUT.png or OUT.exr")->required();
    command->add_option("--camera", o->camera, "a camera of the scene (default: its first)");
    command->add_option("--eye", o->eye, "x,y,z in metres")->delimiter(',')->expected(3);
    command->add_option("--look", o->look, "x,y,z looked at")->delimiter(',')->expected(3);
    command->add_option("--fov", o->fov, "vertical field of view in degrees, with --eye")
        ->check(CLI::Range(1.0, 170.0))
        ->capture_default_str();
    command->add_option("--frames", o->frames, "frames drawn before the picture is taken")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--time", o->time, "seconds")->check(CLI::Range(-1e6, 1e6))->capture_default_str();
    command->add_option("--layer", o->layer, "what to write")
        ->check(CLI::IsMember(Renderer::layer_names()))
        ->capture_default_str();
    command->add_option("--stats", o->stats, "JSON with passes, times, work counts, memory and driver");
    command->callback([o] { run(*o); });
}

}  // namespace tyndall
