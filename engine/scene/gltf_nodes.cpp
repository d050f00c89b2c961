#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <set>
#include <type_traits>

#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

constexpr float brightest_light = 1e15f;  // cd or lx; so that products with it stay finite

/// The parent of each node; checks that the nodes are trees.
std::vector<int> find_parents(const GltfFile& file) {
    const auto& nodes = file.model().nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            (void)file.at(nodes, child, fmt::format("node {}: child", i));
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0) file.fail("node {} has two parents, {} and {}", child, parent, i);
            parent = static_cast<int>(i);
        }
    }
    // Every node has at most one parent, so what no root leads to is on or below a cycle.
    std::vector<int> reached;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] < 0) reached.push_back(static_cast<int>(i));
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const auto& children = nodes[static_cast<std::size_t>(reached[i])].children;
        reached.insert(reached.end(), children.begin(), children.end());
    }
    if (reached.size() != nodes.size()) file.fail("the node hierarchy has a cycle");
    return parents;
}

/// The roots of the scene that is shown: the file's default or first scene; all roots where it has no scenes.
std::vector<int> find_roots(const GltfFile& file, const std::vector<int>& parents) {
    std::vector<int> roots;
    if (file.model().scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] < 0) roots.push_back(static_cast<int>(i));
        return roots;
    }
    roots = file.at(file.model().scenes, std::max(file.model().defaultScene, 0), "scene").nodes;
    for (const int root : roots)
        if (file.at(parents, root, "scene: node") >= 0) file.fail("scene: node {} is not a root", root);
    if (std::set(roots.begin(), roots.end()).size() != roots.size()) file.fail("scene: names a node twice");
    return roots;
}

/// The columns at length 1; those of a scale of 0 so that all are orthogonal.
glm::dmat3 axes_of(const glm::dmat3& linear, glm::dvec3 scale) {
    glm::dmat3 axes(0);
    std::vector<int> flat;
    for (int i = 0; i < 3; ++i) {
        if (scale[i] == 0)
            flat.push_back(i);
        else
            axes[i] = linear[i] / scale[i];
    }
    if (flat.size() == 3) return glm::dmat3(1);
    if (flat.size() == 2) {
        const glm::dvec3 known = glm::abs(axes[3 - flat[0] - flat[1]]);
        glm::dvec3 least(0);
        least[known.x <= known.y && known.x <= known.z ? 0 : known.y <= known.z ? 1 : 2] = 1;
        axes[flat[1]] = glm::normalize(glm::cross(axes[3 - flat[0] - flat[1]], least));
    }
    if (!flat.empty()) axes[flat[0]] = glm::cross(axes[(flat[0] + 1) % 3], axes[(flat[0] + 2) % 3]);
    return axes;
}

/// glTF: a matrix must be a product of translation, rotation and scale. A mirroring goes into the scale of x.
void decompose(const GltfFile& file, const std::vector<double>& values, Node& node, const std::string& what) {
    if (values.size() != 16) file.fail("{}: {} numbers given, 16 expected", what, values.size());
    glm::dmat4 matrix;
    for (std::size_t i = 0; i < 16; ++i) glm::value_ptr(matrix)[i] = file.number(values[i], what);
    const glm::dvec4 last_row(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
    if (!(glm::distance(last_row, glm::dvec4(0, 0, 0, 1)) < 1e-5))
        file.fail("{}: its last row is {} {} {} {}, 0 0 0 1 expected", what, last_row.x, last_row.y, last_row.z,
                  last_row.w);
    const glm::dmat3 linear(matrix);
    glm::dvec3 scale;
    for (int axis = 0; axis < 3; ++axis) scale[axis] = glm::length(linear[axis]);
    if (glm::determinant(linear) < 0) scale.x = -scale.x;
    const glm::dmat3 rotation = axes_of(linear, scale);
    const glm::dmat3 residual = glm::transpose(rotation) * rotation - glm::dmat3(1);
    for (int axis = 0; axis < 3; ++axis)
        if (!(glm::length(residual[axis]) < 1e-3))
            file.fail("{}: it is not a product of translation, rotation and scale", what);
    node.translation = glm::vec3(matrix[3]);
    node.scale = glm::vec3(scale);
    node.rotation = glm::quat(glm::normalize(glm::quat_cast(rotation)));
}

/// Returns the scene's camera; -1 for a kind that is not supported.
int load_camera(const GltfFile& file, const tinygltf::Node& node, int id, Scene& scene, const std::string& what) {
    const tinygltf::Camera& from = file.at(file.model().cameras, node.camera, what + ": camera");
    if (from.type != "perspective") {
        file.skip("{}: orthographic cameras are not supported, left out", what);
        return -1;
    }
    Camera camera;
    camera.name = from.name.empty() ? node.name : from.name;
    camera.node = id;
    camera.yfov = file.number(from.perspective.yfov, what + ": yfov", 1e-4, std::numbers::pi - 1e-4);
    camera.znear = file.number(from.perspective.znear, what + ": znear", 1e-6, 1e6);
    scene.cameras.push_back(camera);
    return static_cast<int>(scene.cameras.size()) - 1;
}

/// A light of the file may be used by many nodes: each gets a light of its own.
int load_light(const GltfFile& file, int index, int id, Scene& scene, const std::string& node) {
    const tinygltf::Light& from = file.at(file.model().lights, index, node + ": light");
    const std::string what = fmt::format("light {} \"{}\"", index, from.name);
    Light light;
    light.name = from.name;
    light.node = id;
    if (from.type == "directional") {
        light.type = LightType::sun;
    } else if (from.type == "spot") {
        light.type = LightType::spot;
        // As the file says them: rounding may swap them.
        const double outer = from.spot.outerConeAngle;
        light.outer_cone = file.number(outer, what + ": outerConeAngle", 1e-4, std::numbers::pi / 2 + 1e-4);
        light.inner_cone =
            std::min(file.number(from.spot.innerConeAngle, what + ": innerConeAngle", 0, outer), light.outer_cone);
    } else if (from.type != "point") {
        file.fail("{}: type {} given, directional, point or spot expected", what, from.type);
    }
    light.intensity = glm::vec3(file.number(from.intensity, what + ": intensity", 0));
    if (!from.color.empty()) light.intensity *= file.vector<3>(from.color, what + ": color", 0);
    const float brightest = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    if (!std::isfinite(brightest)) file.fail("{}: intensity times color is not finite", what);
    if (brightest > brightest_light)
        file.fail("{}: intensity times color is {}, at most {} expected", what, brightest, brightest_light);
    const Json extra = file.extras(from);
    if (extra.contains("radius")) light.radius = file.number(extra["radius"], what + ": extras.radius", 1e-6, 1e6);
    if (extra.contains("shadow")) light.shadow = file.boolean(extra["shadow"], what + ": extras.shadow");
    light.range = file.number(from.range, what + ": range", 0, 1e9);
    scene.lights.push_back(light);
    return static_cast<int>(scene.lights.size()) - 1;
}

glm::dmat4 local_transform(const tinygltf::Node& node) {
    if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
    glm::dmat4 m(1);
    if (!node.translation.empty()) m = glm::translate(m, glm::make_vec3(node.translation.data()));
    if (!node.rotation.empty())
        m *= glm::mat4_cast(
            glm::normalize(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])));
    return node.scale.empty() ? m : glm::scale(m, glm::make_vec3(node.scale.data()));
}

/// What a skin's joints do to vertices where they are in the file.
std::vector<glm::dmat4> rest_pose(const GltfFile& file, int index, const std::vector<int>& parents,
                                  const std::string& what) {
    const tinygltf::Skin& skin = file.at(file.model().skins, index, what + ": skin");
    std::vector<double> inverse_binds;
    if (skin.inverseBindMatrices != -1)
        inverse_binds = file.read(skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4, what + ": inverse bind matrices");
    if (!inverse_binds.empty() && inverse_binds.size() != skin.joints.size() * 16)
        file.fail("{}: skin {} has {} joints and {} inverse bind matrices", what, index, skin.joints.size(),
                  inverse_binds.size() / 16);
    std::vector<glm::dmat4> joints;
    for (const int joint : skin.joints) {
        glm::dmat4 m = inverse_binds.empty() ? glm::dmat4(1) : glm::make_mat4(&inverse_binds[joints.size() * 16]);
        (void)file.at(parents, joint, what + ": joint");
        for (int node = joint; node >= 0; node = parents[static_cast<std::size_t>(node)])
            m = local_transform(file.model().nodes[static_cast<std::size_t>(node)]) * m;
        m[0][3] = m[1][3] = m[2][3] = 0;  // of matrices that are not affine by rounding
        m[3][3] = 1;
        joints.push_back(m);
    }
    if (joints.empty()) file.fail("{}: skin {} has no joints", what, index);
    return joints;
}

/// EXT_mesh_gpu_instancing: a child node for each instance of the last node of the scene, which gives up its
/// meshes.
void load_instances(const GltfFile& file, const tinygltf::Node& from, Scene& scene, const std::string& what) {
    const tinygltf::Value* attributes = file.extension(from, "EXT_mesh_gpu_instancing", "attributes");
    if (attributes == nullptr) file.fail("{}: EXT_mesh_gpu_instancing without attributes", what);
    std::size_t count = 0;
    const auto read = [&]<int n>(const char* key, std::integral_constant<int, n>) {
        std::vector<glm::vec<n, float>> values;
        if (!attributes->Has(key)) return values;
        values = file.read_vectors<n>(attributes->Get(key).GetNumberAsInt(), what + " " + key);
        if (count != 0 && values.size() != count) file.fail("{}: instance attributes differ in count", what);
        count = values.size();
        return values;
    };
    const auto translations = read("TRANSLATION", std::integral_constant<int, 3>());
    const auto rotations = read("ROTATION", std::integral_constant<int, 4>());
    const auto scales = read("SCALE", std::integral_constant<int, 3>());
    Node instance;
    instance.name = from.name;
    instance.parent = static_cast<int>(scene.nodes.size()) - 1;
    instance.cast_shadow = scene.nodes.back().cast_shadow;
    instance.draw_distance = scene.nodes.back().draw_distance;
    std::swap(instance.meshes, scene.nodes.back().meshes);
    for (std::size_t i = 0; i < count; ++i) {
        if (!translations.empty()) instance.translation = translations[i];
        if (!rotations.empty()) instance.rotation = file.quaternion(rotations[i], what + " ROTATION");
        if (!scales.empty()) instance.scale = scales[i];
        scene.nodes.push_back(instance);
    }
}

void load_node(const GltfFile& file, const tinygltf::Node& from, int parent, const std::vector<int>& parents,
               const std::vector<std::vector<int>>& meshes, Scene& scene, const std::string& what) {
    const int id = static_cast<int>(scene.nodes.size());
    Node node;
    node.name = from.name;
    node.parent = parent;
    if (!from.matrix.empty()) {
        decompose(file, from.matrix, node, what + ": matrix");
    } else {
        if (!from.translation.empty()) node.translation = file.vector<3>(from.translation, what + ": translation");
        if (!from.scale.empty()) node.scale = file.vector<3>(from.scale, what + ": scale");
        if (!from.rotation.empty())
            node.rotation =
                file.quaternion(file.vector<4>(from.rotation, what + ": rotation"), what + ": rotation");
    }
    const Json extra = file.extras(from);
    if (extra.contains("cast_shadow"))
        node.cast_shadow = file.boolean(extra["cast_shadow"], what + ": extras.cast_shadow");
    if (extra.contains("draw_distance"))
        node.draw_distance = file.number(extra["draw_distance"], what + ": extras.draw_distance", 0, 1e9);
    if (from.camera != -1) node.camera = load_camera(file, from, id, scene, what);
    if (const auto* light = file.extension(from, "KHR_lights_punctual", "light"))
        node.light = load_light(file, light->GetNumberAsInt(), id, scene, what);
    const bool skinned = from.mesh != -1 && from.skin != -1;
    if (from.mesh != -1 && !skinned) node.meshes = file.at(meshes, from.mesh, what + ": mesh");
    load_particles(file, extra, id, scene, what);
    scene.nodes.push_back(node);
    if (skinned) {  // its joints alone place it: not the node
        file.skip("{}: skins are not moved, drawn in its rest pose", what);
        Node bent;
        bent.name = from.name;
        bent.cast_shadow = node.cast_shadow;
        bent.draw_distance = node.draw_distance;
        bent.meshes = load_mesh(file, from.mesh, rest_pose(file, from.skin, parents, what), scene);
        scene.nodes.push_back(bent);
        return;
    }
    if (from.extensions.contains("EXT_mesh_gpu_instancing")) load_instances(file, from, scene, what);
}

}  // namespace

std::vector<int> load_nodes(const GltfFile& file, const std::vector<std::vector<int>>& meshes, Scene& scene) {
    const auto& nodes = file.model().nodes;
    const std::vector<int> parents = find_parents(file);
    std::vector<int> scene_node(nodes.size(), -1);
    std::vector<int> order = find_roots(file, parents);  // breadth first: parents before children
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto index = static_cast<std::size_t>(order[i]);
        const int parent = parents[index] < 0 ? -1 : scene_node[static_cast<std::size_t>(parents[index])];
        scene_node[index] = static_cast<int>(scene.nodes.size());
        load_node(file, nodes[index], parent, parents, meshes, scene,
                  fmt::format("node {} \"{}\"", index, nodes[index].name));
        order.insert(order.end(), nodes[index].children.begin(), nodes[index].children.end());
    }
    return scene_node;
}

}  // namespace tyndall::gltf
