#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/gltf_parts.h"
#include "engine/scene/mesh_build.h"

namespace tyndall {
namespace {

using gltf::GltfFile;

/// Shows a white surface that the sun meets head on, or without a sun a luminance of 1, as 1/1.2.
float default_exposure(const Scene& scene) {
    const auto sun = scene.sun();
    if (!sun) return 0;
    const glm::vec3& lux = scene.lights[*sun].intensity;
    const float brightest = std::max({lux.r, lux.g, lux.b});
    return brightest > 0 ? std::log2(brightest / std::numbers::pi_v<float>) : 0.0f;
}

/// Of the scene that is shown.
gltf::Json scene_extras(const GltfFile& file) {
    if (file.model().scenes.empty()) return gltf::Json::object();
    return file.extras(file.model().scenes[static_cast<std::size_t>(std::max(file.model().defaultScene, 0))]);
}

void load_exposure(const GltfFile& file, Scene& scene) {
    scene.exposure_ev100 = default_exposure(scene);
    const gltf::Json extra = scene_extras(file);
    if (extra.contains("exposure"))
        scene.exposure_ev100 = file.number(extra["exposure"], "extras.exposure", -64, 64);
}

/// Lamps without a range end where a white surface that faces them would be a quarter of a step of 8 bits brighter
/// than black in the picture, at 0.01 lx at the latest. The window that ends them nowhere takes more than that
/// much.
void end_lamps(Scene& scene) {
    constexpr float step = 1 / (255 * 12.92f);                   // sRGB is linear there
    const float white = 1.2f * std::exp2(scene.exposure_ev100);  // cd/m²
    const float least = std::clamp(0.25f * step * std::numbers::pi_v<float> * white, 1e-12f, 0.01f);
    for (Light& light : scene.lights) {
        if (light.type == LightType::sun || light.range > 0) continue;
        const float brightest = std::max({light.intensity.r, light.intensity.g, light.intensity.b});
        light.range = std::max(std::sqrt(brightest / least), light.radius);
    }
}

constexpr float farthest = 1e9f;  // m; squares and products of distances stay finite

/// How far from its parent, and how large, a node is at most at any time of its animations.
struct Reach {
    double distance = 0, scale = 1;
};

Reach own_reach(const Scene& scene, int index) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    glm::dvec3 translation = glm::abs(glm::dvec3(node.translation)), scale = glm::abs(glm::dvec3(node.scale));
    for (const Animation& animation : scene.animations) {
        for (const Animation::Channel& channel : animation.channels) {
            if (channel.node != index || channel.path == Animation::Path::rotation) continue;
            glm::dvec3& most = channel.path == Animation::Path::scale ? scale : translation;
            for (const glm::vec4& value : channel.values) most = glm::max(most, glm::abs(glm::dvec3(value)));
            // A spline leaves its keys by less than their span times the larger tangent.
            if (channel.interpolation == Animation::Interpolation::cubic)
                most *= 2 * (1 + double{channel.times.back()});
        }
    }
    return {glm::length(translation), std::max({scale.x, scale.y, scale.z})};
}

/// What moves is checked for all times, by bounds that a scene of any size keeps.
void check_animations(const GltfFile& file, const Scene& scene) {
    std::vector<Reach> reach;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const Reach parent = node.parent < 0 ? Reach{} : reach[static_cast<std::size_t>(node.parent)];
        const Reach own = own_reach(scene, static_cast<int>(i));
        reach.push_back({parent.distance + parent.scale * own.distance, parent.scale * own.scale});
        double size = 0;
        for (const int mesh : node.meshes) {
            const Aabb& box = scene.meshes[static_cast<std::size_t>(mesh)].bounds;
            if (!box.empty())
                size = std::max<double>(size, glm::length(glm::max(glm::abs(box.min), glm::abs(box.max))));
        }
        const double most = reach.back().distance + reach.back().scale * size;
        if (node.dynamic && !(most <= farthest && reach.back().scale < 1e30))
            file.fail("node \"{}\": its animation may take it {} m far, at most {} m expected", node.name, most,
                      farthest);
    }
}

void place_in_world(const GltfFile& file, Scene& scene) {
    animate(scene, 0);
    for (const Node& node : scene.nodes) {
        for (int column = 0; column < 4; ++column)
            if (!std::isfinite(glm::length(node.world[column])))
                file.fail("node \"{}\": its place in the world is not finite", node.name);
        if (glm::length(glm::vec3(node.world[3])) > farthest)
            file.fail("node \"{}\": it is farther than {} m from the origin", node.name, farthest);
        for (const int mesh : node.meshes) {
            const Aabb box = transformed(scene.meshes[static_cast<std::size_t>(mesh)].bounds, node.world);
            if (box.empty()) continue;
            const glm::vec3 most = glm::max(glm::abs(box.min), glm::abs(box.max));
            if (!(std::max({most.x, most.y, most.z}) <= farthest))
                file.fail("node \"{}\": its mesh reaches farther than {} m from the origin", node.name, farthest);
            scene.bounds.add(box.min);
            scene.bounds.add(box.max);
        }
    }
    check_animations(file, scene);
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const std::optional<std::string>& animation) {
    GltfNotes notes;
    Scene scene = load_gltf(path, notes, animation);
    for (const auto& lines : {notes.doubts, notes.left_out})
        for (const std::string& line : lines) spdlog::warn("{}", gltf::one_line(path.string() + ": " + line));
    return scene;
}

Scene load_gltf(const std::filesystem::path& path, GltfNotes& notes, const std::optional<std::string>& animation) {
    try {
        const GltfFile file(path);
        Scene scene;
        scene.path = path;
        gltf::load_materials(file, scene);
        const auto meshes = gltf::load_meshes(file, scene);
        const auto nodes = gltf::load_nodes(file, meshes, scene);
        gltf::load_animations(file, nodes, animation, scene);
        gltf::load_media(file, scene_extras(file), nodes, scene);
        load_exposure(file, scene);
        end_lamps(scene);
        gltf::light_unlit(file, scene);
        gltf::tell_ignored_extras(file);
        gltf::doubt_empty_materials(file, scene);
        if (scene.materials.empty()) scene.materials.emplace_back().name = "default";
        place_in_world(file, scene);
        notes = {.generator = gltf::one_line(file.model().asset.generator),
                 .extensions = file.model().extensionsUsed,
                 .exposure = scene_extras(file).contains("exposure"),
                 .left_out = {file.skipped().begin(), file.skipped().end()},
                 .doubts = {file.doubts().begin(), file.doubts().end()}};
        return scene;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {  // what libraries throw on odd input
        throw Error(gltf::one_line(path.string() + ": not a valid glTF 2.0 file: " + e.what()));
    }
}

}  // namespace tyndall
