#include <algorithm>
#include <cmath>
#include <map>
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

void load_scene_extras(const GltfFile& file, Scene& scene) {
    scene.exposure_ev100 = default_exposure(scene);
    if (file.model().scenes.empty()) return;
    const auto index = static_cast<std::size_t>(std::max(file.model().defaultScene, 0));
    const gltf::Json extra = file.extras(file.model().scenes[index]);
    if (extra.contains("exposure")) scene.exposure_ev100 = file.number(extra["exposure"], "extras.exposure");
    if (!extra.contains("media")) return;
    gltf::Json media = extra["media"];
    if (media.is_string()) {  // a text property of a modelling program
        media = gltf::Json::parse(media.get<std::string>(), nullptr, false);
        if (media.is_discarded()) file.fail("extras.media: the text is not valid JSON");
    }
    scene.media = parse_media(media, scene.path.string() + ": extras");
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

/// Nodes whose transform mirrors get meshes with turned faces, made once for each mesh.
void turn_mirrored_meshes(Scene& scene) {
    std::map<int, int> turned;
    for (Node& node : scene.nodes) {
        if (glm::determinant(glm::mat3(node.world)) >= 0) continue;
        for (int& mesh : node.meshes) {
            const auto [entry, added] = turned.try_emplace(mesh, static_cast<int>(scene.meshes.size()));
            if (added) scene.meshes.push_back(mirrored(scene.meshes[static_cast<std::size_t>(mesh)]));
            mesh = entry->second;
        }
    }
}

void place_in_world(const GltfFile& file, Scene& scene) {
    constexpr float farthest = 1e9f;  // m; squares and products of distances stay finite
    animate(scene, 0);
    for (const Node& node : scene.nodes) {
        for (int column = 0; column < 4; ++column)
            if (!std::isfinite(glm::length(node.world[column])))
                file.fail("node \"{}\": its place in the world is not finite", node.name);
        if (glm::length(glm::vec3(node.world[3])) > farthest)
            file.fail("node \"{}\": it is farther than {} m from the origin", node.name, farthest);
    }
    turn_mirrored_meshes(scene);
    for (const Node& node : scene.nodes) {
        for (const int mesh : node.meshes) {
            const Aabb box = transformed(scene.meshes[static_cast<std::size_t>(mesh)].bounds, node.world);
            scene.bounds.add(box.min);
            scene.bounds.add(box.max);
        }
    }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& path) {
    try {
        const GltfFile file(path);
        Scene scene;
        scene.path = path;
        gltf::load_materials(file, scene);
        const auto meshes = gltf::load_meshes(file, scene);
        const auto nodes = gltf::load_nodes(file, meshes, scene);
        gltf::load_animations(file, nodes, scene);
        load_scene_extras(file, scene);
        end_lamps(scene);
        if (scene.materials.empty()) scene.materials.emplace_back().name = "default";
        place_in_world(file, scene);
        return scene;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {  // what libraries throw on odd input
        throw Error(gltf::one_line(path.string() + ": not a valid glTF 2.0 file: " + e.what()));
    }
}

}  // namespace tyndall
