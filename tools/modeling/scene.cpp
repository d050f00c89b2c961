#include "tools/modeling/scene.h"

#include "tools/modeling/random.h"

namespace tyndall::modeling {

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

Pose looking_along(vec3 eye, vec3 direction) {
    return {eye, arctangent(-direction.x, -direction.z) * 180.0f / kPi, arcsine(direction.y) * 180.0f / kPi};
}

int Scene::add_mesh(Mesh mesh) {
    meshes.push_back(std::move(mesh));
    return static_cast<int>(meshes.size()) - 1;
}

int Scene::add_node(Node node) {
    nodes.push_back(std::move(node));
    return static_cast<int>(nodes.size()) - 1;
}

int Scene::add_static(Mesh mesh) {
    Node node;
    node.name = mesh.name;
    node.mesh = add_mesh(std::move(mesh));
    return add_node(std::move(node));
}

int Scene::add_instance(const std::string& name, int mesh, vec3 position, float yaw_degrees, float scale) {
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.translation = position;
    node.rotation = yaw_rotation(yaw_degrees);
    node.scale = scale;
    return add_node(std::move(node));
}

int Scene::add_light(const Light& light, vec3 position, quat rotation) {
    lights.push_back(light);
    Node node;
    node.name = light.name;
    node.light = static_cast<int>(lights.size()) - 1;
    node.translation = position;
    node.rotation = rotation;
    return add_node(std::move(node));
}

void Scene::add_camera(const std::string& name, float yfov_degrees, const Pose& pose) {
    cameras.push_back({name, yfov_degrees * kPi / 180.0f});
    Node node;
    node.name = name;
    node.camera = static_cast<int>(cameras.size()) - 1;
    node.translation = pose.eye;
    node.rotation = pose.rotation();
    add_node(std::move(node));
}

mat4 Scene::world(int node) const {
    const Node& n = nodes[static_cast<size_t>(node)];
    mat4 m = glm::mat4_cast(n.rotation);
    for (int k = 0; k < 3; ++k) m[k] *= n.scale;
    m[3] = vec4(n.translation, 1.0f);
    return n.parent < 0 ? m : world(n.parent) * m;
}

size_t Scene::triangles() const {
    size_t count = 0;
    for (const Node& node : nodes) {
        if (node.mesh >= 0) count += meshes[static_cast<size_t>(node.mesh)].triangles();
    }
    return count;
}

}  // namespace tyndall::modeling
