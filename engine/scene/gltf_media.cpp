#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <string_view>

#include "engine/core/files.h"
#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

/// A dictionary or list, which modelling programs also keep as text.
Json from_text(const GltfFile& file, const Json& given, const std::string& what) {
    if (!given.is_string()) return given;
    try {
        return parse_json(given.get<std::string>());
    } catch (const Error& e) {
        file.fail("{}: the text is not valid JSON: {}", what, e.what());
    }
}

/// Where a node has its medium: the box round its meshes, or without any from -1 to 1 m, in the node's transform.
struct Placement {
    glm::dvec3 center, half_extent;  ///< m
    glm::dvec3 origin, scale;        ///< of the node
    glm::dquat rotation;
    bool mirrored;
};

Placement placement_of(const GltfFile& file, const Scene& scene, const Node& node, const std::string& what) {
    Aabb box;
    for (const int mesh : node.meshes) {
        const Aabb& bounds = scene.meshes[static_cast<std::size_t>(mesh)].bounds;
        box.add(bounds.min);
        box.add(bounds.max);
    }
    if (box.empty()) box = {glm::vec3(-1), glm::vec3(1)};
    const glm::dvec3 low(box.min), high(box.max);

    const glm::dmat4 world(node.world);
    glm::dmat3 axes(world);
    glm::dvec3 scale;
    for (int i = 0; i < 3; ++i) {
        scale[i] = glm::length(axes[i]);
        if (!(scale[i] > 0)) file.fail("{}: the node has a scale of 0, a size expected", what);
        axes[i] /= scale[i];
    }
    const double skew = std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                                  std::abs(glm::dot(axes[2], axes[0]))});
    if (!(skew < 1e-3))
        file.fail("{}: the scales of its parents shear the node, right angles between its axes expected", what);
    const bool mirrored = glm::determinant(axes) < 0;
    if (mirrored) axes[0] = -axes[0];  // shapes are alike on both sides of their centre
    return {glm::dvec3(world * glm::dvec4((low + high) / 2.0, 1)),
            scale * (high - low) / 2.0,
            glm::dvec3(world[3]),
            scale,
            glm::normalize(glm::quat_cast(axes)),
            mirrored};
}

bool is_uniform(const glm::dvec3& v) {
    const double most = std::max({v.x, v.y, v.z});
    return most - std::min({v.x, v.y, v.z}) <= 1e-3 * most;
}

Json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Says the place and size of the node as a media file does.
void place(const GltfFile& file, const Placement& at, Json& medium, const std::string& what) {
    for (const char* key : {"center", "size", "radius", "radii", "translation", "rotation", "scale"})
        if (medium.contains(key)) file.fail("{}.{}: none expected, as the node says it", what, key);
    const Json shape = medium.emplace("shape", "box").first.value();
    medium["rotation"] = {at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w};
    medium["center"] = numbers(at.center);
    if (shape == "box") {
        medium["size"] = numbers(2.0 * at.half_extent);
    } else if (shape == "ellipsoid") {
        medium["radii"] = numbers(at.half_extent);
    } else if (shape == "sphere") {
        if (!is_uniform(at.half_extent))
            file.fail("{}: the node makes radii of {:.6g} {:.6g} {:.6g} m of the sphere, an ellipsoid expected",
                      what, at.half_extent.x, at.half_extent.y, at.half_extent.z);
        medium["radius"] = at.half_extent.x;
    } else if (shape == "grid") {
        if (!is_uniform(at.scale) || at.mirrored)
            file.fail("{}: the node scales by {:.6g} {:.6g} {:.6g}{}, one scale for all axes of a grid expected",
                      what, at.scale.x, at.scale.y, at.scale.z, at.mirrored ? " and mirrors" : "");
        medium.erase("center");
        medium["translation"] = numbers(at.origin);
        medium["scale"] = at.scale.x;
    } else {
        file.fail(
            "{}.shape: {} given, one of box, ellipsoid, sphere, grid expected; others belong to the scene's media",
            what, one_line(shape.dump()));
    }
}

}  // namespace

void load_media(const GltfFile& file, const Json& scene_extras, const std::vector<int>& nodes, Scene& scene) {
    const std::filesystem::path folder = scene.path.parent_path();
    if (scene_extras.contains("media"))
        scene.media = parse_media(from_text(file, scene_extras["media"], "extras.media"),
                                  scene.path.string() + ": extras", folder);
    animate(scene, 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const tinygltf::Node& from = file.model().nodes[i];
        const Json extras = file.extras(from);
        if (nodes[i] < 0 || !extras.contains("medium")) continue;
        Node& node = scene.nodes[static_cast<std::size_t>(nodes[i])];
        const std::string what = fmt::format("node {} \"{}\": extras.medium", i, from.name);
        Json medium = from_text(file, extras["medium"], what);
        if (!medium.is_object())
            file.fail("{}: {} given, an object that describes one medium expected", what, one_line(medium.dump()));
        if (from.skin != -1 || from.extensions.contains("EXT_mesh_gpu_instancing"))
            file.fail("{}: the node has a skin or instances, a mesh alone or none expected", what);
        place(file, placement_of(file, scene, node, what), medium, what);
        if (node.dynamic) file.skip("{}: it stays where the node begins", what);
        scene.media.push_back(parse_medium(medium, one_line(scene.path.string() + ": " + what), folder));
        node.meshes.clear();  // they say where it is
    }
}

}  // namespace tyndall::gltf
