#include "sample_game/session.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/log.h"

namespace tyndall {

namespace {

constexpr int max_side = 16384;

Scene load_scene(const DrawOptions& o, bool window) {
    Scene scene = load_gltf(o.scene);
    if (o.media) scene.media = load_media(*o.media);
    add_missing_camera(scene);
    if (window) add_missing_sun(scene);
    animate(scene, 0);
    return scene;
}

}  // namespace

void DrawOptions::add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size) {
    scene = default_scene;
    size = default_size;
    auto* scene_option = command.add_option("SCENE", scene, "a glTF scene (.glb or .gltf)");
    if (default_scene.empty()) scene_option->required();
    command.add_option("--size", size, "pixels, WxH")->capture_default_str();
    command.add_option("--context", context, "auto, egl, osmesa or glfw")->capture_default_str();
    command.add_option("--media", media, "media file that replaces the scene's own media");
    command.add_option("--technique", technique, "volumetric technique (tyndall list techniques)");
    command.add_option("--preset", preset, "settings preset: a name (tyndall list presets) or a file");
    command.add_option("--set", set, "key=value, repeatable (tyndall list settings)")
        ->take_all()
        ->allow_extra_args(false);
}

glm::ivec2 DrawOptions::pixels() const {
    glm::ivec2 p{0};
    const std::size_t x = size.find('x');
    bool ok = x != std::string::npos;
    if (ok) {
        const char* begin = size.data();
        const auto w = std::from_chars(begin, begin + x, p.x);
        const auto h = std::from_chars(begin + x + 1, begin + size.size(), p.y);
        ok = w.ec == std::errc{} && h.ec == std::errc{} && w.ptr == begin + x && h.ptr == begin + size.size();
    }
    if (!ok || p.x < 1 || p.y < 1 || p.x > max_side || p.y > max_side)
        throw UsageError(fmt::format("--size {}: expected WxH with both in 1..{}", size, max_side));
    return p;
}

Session::Session(const DrawOptions& o, bool window) : size(o.pixels()) {
    settings.add(volumetrics::settings_table(), &options.volumetrics);
    settings.add(render_settings_table(), &options.render);
    if (o.preset) apply_preset(settings, *o.preset);
    if (o.technique) settings.set("technique", *o.technique);
    for (const std::string& assignment : o.set) settings.set(assignment);
    ContextRequest request;
    request.kind = parse_context_kind(o.context);
    request.size = size;
    request.window = window;

    scene = load_scene(o, window);
    context = create_context(request);
    shaders = std::make_unique<ShaderLibrary>(data_root());
    timer = std::make_unique<gl::GpuTimer>(gl::TimerMode::off);
    renderer = std::make_unique<Renderer>(*shaders);
    renderer->prepare(scene, context->capabilities().software ? 1.0f : 4.0f);
    options.timer = timer.get();
    const volumetrics::Settings& v = options.volumetrics;
    if (context->capabilities().software && v.technique == volumetrics::Technique::ray_march && v.steps > 256)
        spdlog::warn(
            "on this driver shaders lose light where loops are long: {} steps among many lamps are too many",
            v.steps);
}

void Session::draw(const View& view, double time) {
    options.time = time;
    renderer->render(scene, view, size, options);
    ++options.frame_index;
}

gl::TimerMode Session::timer_mode() const {
    return context->capabilities().software ? gl::TimerMode::finish : gl::TimerMode::query;
}

View camera_view(const Scene& scene, const std::string& name, float aspect) {
    const Camera* camera = scene.find_camera(name);
    if (camera == nullptr) {
        std::vector<std::string> names;
        for (const Camera& c : scene.cameras) names.push_back(c.name);
        throw UsageError(
            fmt::format("camera {}: not in {}, which has {}", name, scene.path.string(), fmt::join(names, ", ")));
    }
    return make_view(scene.nodes[camera->node].world, camera->yfov, camera->znear, aspect);
}

void apply_preset(SettingsSet& settings, const std::string& name_or_path) {
    std::filesystem::path path = name_or_path;
    if (!path.has_extension()) {
        const std::vector<std::string> names = preset_names();
        if (std::find(names.begin(), names.end(), name_or_path) == names.end())
            throw UsageError(fmt::format("preset {}: unknown, expected {} or a .json file", name_or_path,
                                         fmt::join(names, ", ")));
        path = data_root() / "assets/presets" / (name_or_path + ".json");
    }
    settings.from_json(read_json(path), path.string());
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(data_root() / "assets/presets"))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace tyndall
