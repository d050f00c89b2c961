#include "session/session.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "engine/core/log.h"
#include "engine/scene/data_root.h"
#include "engine/shader/build_time.h"

namespace tyndall {

void DrawOptions::add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size) {
    SceneOptions::add_to(command, default_scene, default_size);
    command.add_option("--context", context, "auto, egl, osmesa or glfw")->capture_default_str();
}

Session::Session(const DrawOptions& o, bool window, const Announce& announce, const Furnish& furnish)
    : size(o.pixels()) {
    const auto tell = [&](const std::string& doing) {
        if (announce) announce(*this, doing);
    };
    settings.add(volumetrics::settings_table(), &volumetrics.settings);
    settings.add(render_settings_table(), &options.render);
    o.apply(settings);
    ContextRequest request;
    request.kind = parse_context_kind(o.context);
    request.size = size;
    request.window = window;
    startup.did("settings");

    context = create_context(request);
    shaders = std::make_unique<ShaderLibrary>(data_root());
    startup.did("context");
    tell("reading " + std::filesystem::path(o.scene).filename().string());
    if (announce) startup.did("loading picture");
    scene = o.load();
    if (window) {
        add_missing_sun(scene);
        animate(scene, 0);
    }
    if (furnish) furnish(scene);
    startup.did("scene");
    tell("uploading meshes and pictures");
    timer = std::make_unique<gl::GpuTimer>(gl::TimerMode::off);
    renderer = std::make_unique<Renderer>(*shaders, std::vector<FrameModule*>{&volumetrics});
    renderer->prepare(scene, context->capabilities().software ? 1.0f : 4.0f);
    options.timer = timer.get();
    startup.did("upload");
    tell("building shaders and shadow maps");
    const volumetrics::Settings& v = volumetrics.settings;
    if (context->capabilities().software && v.technique == "ray_march" && v.march.steps > 256)
        spdlog::warn(
            "on this driver shaders lose light where loops are long: {} steps among many lamps are too many",
            v.march.steps);
}

void Session::draw(const View& view, double time) {
    options.time = time;
    const bool first = !std::exchange(started_, true);
    if (first) startup.did("game");
    const double built = seconds_building_shaders();
    renderer->render(scene, view, size, options);
    ++options.frame_index;
    if (!first) return;
    glFinish();
    startup.did("first frame", {"shaders", (seconds_building_shaders() - built) * 1e3});
}

std::vector<std::string> Session::layer_names() {
    VolumetricsAdapter volumetrics;
    FrameModule* const modules[] = {&volumetrics};
    return Renderer::layer_names(modules);
}

gl::TimerMode Session::timer_mode() const {
    return context->capabilities().software ? gl::TimerMode::finish : gl::TimerMode::query;
}

}  // namespace tyndall
