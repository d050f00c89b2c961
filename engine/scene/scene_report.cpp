#include "engine/scene/scene_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;

/// A name of the file, quoted, its control characters escaped.
std::string quoted(const std::string& name) {
    return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Numbers as people write them: four digits, and 0 for what rounding left.
std::string numbers(const glm::vec3& v) {
    std::string text;
    for (int i = 0; i < 3; ++i)
        text += fmt::format("{}{:.4g}", i == 0 ? "" : " ", std::abs(v[i]) < 1e-6f ? 0.0f : v[i]);
    return text;
}

/// "cameras: 2" and a line for each; "cameras: none".
std::string list(const char* title, const Lines& lines) {
    if (lines.empty()) return fmt::format("{}: none\n", title);
    return fmt::format("{}: {}\n  {}\n", title, lines.size(), fmt::join(lines, "\n  "));
}

std::string geometry(const Scene& scene) {
    std::size_t stored = 0, drawn = 0;
    for (const Mesh& mesh : scene.meshes) stored += mesh.indices.size() / 3;
    for (const Node& node : scene.nodes)
        for (const int mesh : node.meshes) drawn += scene.meshes[static_cast<std::size_t>(mesh)].indices.size() / 3;
    std::string text = fmt::format("nodes: {}\nmeshes: {}, of {} triangles; all instances have {}\nmaterials: {}\n",
                                   scene.nodes.size(), scene.meshes.size(), stored, drawn, scene.materials.size());
    if (scene.bounds.empty()) return text + "bounds: none\n";
    return text + fmt::format("bounds: {} to {} m, {} m wide, high and deep\n", numbers(scene.bounds.min),
                              numbers(scene.bounds.max), numbers(scene.bounds.max - scene.bounds.min));
}

std::string cameras(const Scene& scene) {
    Lines lines;
    for (const Camera& camera : scene.cameras)
        lines.push_back(fmt::format("{}: perspective, {:.1f}° vertical, at {} m", quoted(camera.name),
                                    glm::degrees(camera.yfov), numbers(node_pose(scene, camera.node)[3])));
    return list("cameras", lines);
}

std::string lights(const Scene& scene) {
    Lines lines;
    for (const Light& light : scene.lights) {
        const glm::mat4 pose = node_pose(scene, light.node);
        const float most = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
        const bool sun = light.type == LightType::sun, spot = light.type == LightType::spot;
        std::string line = fmt::format("{}: {}, {:.4g} {}", quoted(light.name),
                                       sun    ? "sun"
                                       : spot ? "spot"
                                              : "point",
                                       most, sun ? "lx" : "cd");
        if (most > 0) line += fmt::format(", color {}", numbers(light.intensity / most));
        if (!sun) line += fmt::format(", at {} m", numbers(pose[3]));
        if (sun || spot) line += fmt::format(", towards {}", numbers(-pose[2]));
        if (spot)
            line += fmt::format(", cone {:.1f}° full to {:.1f}° dark from its axis", glm::degrees(light.inner_cone),
                                glm::degrees(light.outer_cone));
        if (!sun) line += fmt::format(", range {:.4g} m, radius {:.4g} m", light.range, light.radius);
        lines.push_back(line + (light.shadow ? "" : ", no shadow"));
    }
    return list("lights", lines);
}

std::string place_of(const Medium& medium) {
    const bool grid = medium.shape == Medium::Shape::grid;
    if (!is_bounded(medium))
        return medium.height_profile
                   ? fmt::format(" above {:.4g} m, thinner by e in {:.4g} m", medium.base, medium.falloff)
                   : "";
    std::string text;
    if (grid) {
        const Aabb box = world_bounds(medium);
        text = medium.grid->empty() ? " that is empty"
                                    : fmt::format(" from {} to {} m, density up to {:.4g}", numbers(box.min),
                                                  numbers(box.max), medium.density * medium.grid->greatest);
    } else {
        text = fmt::format(" at {} m, {} m wide, high and deep", numbers(medium.center),
                           numbers(2.0f * medium.half_extent));
    }
    const glm::quat& q = medium.rotation;
    if (std::abs(q.w) < 0.999999f)
        text += fmt::format(", turned by {:.3g} {:.3g} {:.3g} {:.3g}", q.x, q.y, q.z, q.w);
    return text;
}

std::string media(const Scene& scene) {
    Lines lines;
    for (const Medium& medium : scene.media) {
        const glm::vec3 extinction = medium.sigma_s + medium.sigma_a;
        const float most = std::max({extinction.r, extinction.g, extinction.b});
        std::string line = fmt::format("{}{}: scattering {}, absorption {} 1/m", name_of(medium.shape),
                                       place_of(medium), numbers(medium.sigma_s), numbers(medium.sigma_a));
        if (most > 0) line += fmt::format(", mean free path {:.4g} m", 1 / most);
        if (medium.emission != glm::vec3(0))
            line += fmt::format(", emission {} cd/m² a metre", numbers(medium.emission));
        lines.push_back(line);
    }
    return list("media", lines);
}

std::string textures(const Scene& scene) {
    Lines lines;
    for (const Picture& picture : scene.pictures)
        lines.push_back(fmt::format("{}: {} x {}", quoted(picture.name), picture.size.x, picture.size.y));
    return list("textures", lines);
}

std::string animations(const Scene& scene) {
    Lines lines;
    for (const Animation& animation : scene.animations)
        lines.push_back(fmt::format("{}: {:.4g} s, {} channels", quoted(animation.name), animation.duration,
                                    animation.channels.size()));
    return list("animations", lines);
}

}  // namespace

std::string report(const Scene& scene, const GltfNotes& notes, const std::vector<std::string>& doubts) {
    std::string text = fmt::format("scene: {}\n", scene.path.string());
    if (!notes.generator.empty()) text += fmt::format("written by: {}\n", notes.generator);
    text += geometry(scene);
    text += fmt::format("exposure: EV {:.2f}{}, a luminance of {:.3g} cd/m² shows as 1\n", scene.exposure_ev100,
                        notes.exposure ? "" : " (the file gives none)", 1.2f * std::exp2(scene.exposure_ev100));
    text += cameras(scene) + lights(scene) + media(scene);
    text += fmt::format("particle emitters: {}\n", scene.emitters.size());
    text += textures(scene) + animations(scene);
    text += list("extensions", notes.extensions);
    return text + list("left out", notes.left_out) + list("warnings", doubts);
}

}  // namespace tyndall
