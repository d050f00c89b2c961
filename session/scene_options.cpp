#include "session/scene_options.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/scene/data_root.h"
#include "session/number_option.h"

namespace tyndall {
namespace {

constexpr int max_side = 16384;
constexpr float default_znear = 0.1f;
constexpr double default_fov = 60;     // degrees
constexpr double far_out = 1e6;        // m: as far from the origin as pictures are right
constexpr float nearest_look = 1e-6f;  // m

glm::vec3 point(const std::vector<double>& xyz) {
    return glm::vec3(glm::dvec3(xyz[0], xyz[1], xyz[2]));
}

}  // namespace

void SceneOptions::add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size) {
    scene = default_scene;
    size = default_size;
    auto* scene_option = command.add_option("SCENE", scene, "a glTF scene (.glb or .gltf)");
    if (default_scene.empty()) scene_option->required();
    command.add_option("--size", size, "pixels, WxH")->capture_default_str();
    command.add_option("--animation", animation, "the only animation of the scene that plays (default: all)");
    command.add_option("--media", media, "media file that replaces the scene's own media");
    command.add_option("--add-media", add_media, "media file whose media are added");
    command.add_option("--technique", technique, "volumetric technique (tyndall list techniques)");
    command.add_option("--preset", preset, "settings preset: a name (tyndall list presets) or a file");
    command.add_option("--set", set, "key=value, repeatable (tyndall list settings)")
        ->take_all()
        ->allow_extra_args(false);
}

glm::ivec2 SceneOptions::pixels() const {
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

void SceneOptions::apply(SettingsSet& settings) const {
    if (preset) apply_preset(settings, *preset);
    if (technique) settings.set("technique", *technique);
    for (const std::string& assignment : set) settings.set(assignment);
}

std::vector<NamedFile> SceneOptions::inputs() const {
    std::vector<NamedFile> files{{"SCENE", scene}};
    if (media) files.push_back({"--media", *media});
    if (add_media) files.push_back({"--add-media", *add_media});
    if (preset) files.push_back({"--preset", *preset});
    return files;
}

Scene SceneOptions::load() const {
    Scene loaded = load_gltf(scene, animation);
    if (media) loaded.media = load_media(*media);
    if (add_media) std::ranges::move(load_media(*add_media), std::back_inserter(loaded.media));
    add_missing_camera(loaded);
    animate(loaded, 0);
    return loaded;
}

void ViewOptions::add_to(CLI::App& command) {
    command.add_option("--camera", camera, "a camera of the scene (default: its first)");
    const auto add_point = [&](const char* name, std::vector<double>& value, const char* help) {
        command.add_option(name, value, help)->delimiter(',')->expected(3)->check(number_in(-far_out, far_out));
    };
    add_point("--eye", eye, "x,y,z in metres");
    add_point("--look", look, "x,y,z looked at");
    command
        .add_option("--fov", fov, fmt::format("vertical field of view in degrees, with --eye ({})", default_fov))
        ->check(number_in(1, 170));
    command.add_option("--time", time, "seconds (0)")->check(number_in(-1e6, 1e6));
}

void ViewOptions::check() const {
    if (eye.empty() != look.empty()) throw UsageError("--eye and --look go together");
    if (!eye.empty() && camera) throw UsageError("--camera and --eye exclude each other");
    if (fov && eye.empty()) throw UsageError("--fov needs --eye: a camera of the scene has its own field of view");
    if (!eye.empty() && glm::distance(point(eye), point(look)) < nearest_look)
        throw UsageError("--look: a point apart from --eye expected, which gives a direction");
}

View ViewOptions::view(const Scene& scene, glm::ivec2 size) const {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    if (!eye.empty())
        return look_at(point(eye), point(look), static_cast<float>(glm::radians(fov.value_or(default_fov))),
                       default_znear, aspect);
    return camera_view(scene, camera.value_or(scene.cameras.front().name), aspect);
}

View camera_view(const Scene& scene, const std::string& name, float aspect) {
    const Camera* camera = scene.find_camera(name);
    if (camera == nullptr) {
        std::vector<std::string> names;
        for (const Camera& c : scene.cameras) names.push_back(c.name);
        throw UsageError(
            fmt::format("camera {}: not in {}, which has {}", name, scene.path.string(), fmt::join(names, ", ")));
    }
    return make_view(node_pose(scene, camera->node), camera->yfov, camera->znear, aspect);
}

void check_picture_name(const std::string& option, const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension != ".png" && extension != ".exr")
        throw UsageError(fmt::format("{} {}: expected a name ending in .png or .exr", option, path.string()));
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
