#include "tools/level/level.h"

#include "tools/level/parts.h"
#include "tools/level/random.h"

namespace tyndall::level {

quat yaw_rotation(float degrees) {
    const float half = degrees * kPi / 360.0f;
    return {cosine(half), 0.0f, sine(half), 0.0f};
}

quat Pose::rotation() const {
    const float half = pitch * kPi / 360.0f;
    return yaw_rotation(yaw) * quat(cosine(half), sine(half), 0.0f, 0.0f);
}

vec3 Pose::forward() const {
    return rotation() * vec3(0, 0, -1);
}

int Level::add_mesh(Mesh mesh) {
    meshes.push_back(std::move(mesh));
    return static_cast<int>(meshes.size()) - 1;
}

int Level::add_node(Node node) {
    nodes.push_back(std::move(node));
    return static_cast<int>(nodes.size()) - 1;
}

int Level::add_static(Mesh mesh) {
    Node node;
    node.name = mesh.name;
    node.mesh = add_mesh(std::move(mesh));
    return add_node(std::move(node));
}

int Level::add_instance(const std::string& name, int mesh, vec3 position, float yaw_degrees, float scale) {
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.translation = position;
    node.rotation = yaw_rotation(yaw_degrees);
    node.scale = scale;
    return add_node(std::move(node));
}

int Level::add_light(const Light& light, vec3 position, quat rotation) {
    lights.push_back(light);
    Node node;
    node.name = light.name;
    node.light = static_cast<int>(lights.size()) - 1;
    node.translation = position;
    node.rotation = rotation;
    return add_node(std::move(node));
}

void Level::add_camera(const std::string& name, float yfov_degrees, const Pose& pose) {
    cameras.push_back({name, yfov_degrees * kPi / 180.0f});
    Node node;
    node.name = name;
    node.camera = static_cast<int>(cameras.size()) - 1;
    node.translation = pose.eye;
    node.rotation = pose.rotation();
    add_node(std::move(node));
}

mat4 Level::world(int node) const {
    const Node& n = nodes[static_cast<size_t>(node)];
    mat4 m = glm::mat4_cast(n.rotation);
    for (int k = 0; k < 3; ++k) m[k] *= n.scale;
    m[3] = vec4(n.translation, 1.0f);
    return n.parent < 0 ? m : world(n.parent) * m;
}

size_t Level::triangles() const {
    size_t count = 0;
    for (const Node& node : nodes) {
        if (node.mesh >= 0) count += meshes[static_cast<size_t>(node.mesh)].triangles();
    }
    return count;
}

vec3 to_sun() {
    constexpr float kElevation = 16.0f * kPi / 180.0f, kSouthOfWest = 42.0f * kPi / 180.0f;
    return {-cosine(kElevation) * cosine(kSouthOfWest), sine(kElevation), cosine(kElevation) * sine(kSouthOfWest)};
}

Level build_level() {
    Level level;
    const Lamps lamps = make_lamps(level);
    const Props props = make_props(level);
    add_sun(level);
    add_terrain(level);
    add_abbey(level, lamps, props);
    add_cloister(level, lamps, props);
    add_street(level, lamps, props);
    add_tree(level);
    add_media(level);
    add_cameras(level);
    return level;
}

}  // namespace tyndall::level
