#include "support/test_scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace tyndall::test {
namespace {

void quad(Mesh& mesh, glm::vec3 center, glm::vec3 u, glm::vec3 v) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 c : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.vertices.push_back(
            {center + c.x * u + c.y * v, normal, glm::vec4(glm::normalize(u), 1), c * 0.5f + 0.5f});
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

}  // namespace

glm::mat4 pose(glm::vec3 position, glm::vec3 direction) {
    const glm::vec3 up =
        std::abs(direction.y) > 0.9f * glm::length(direction) ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::inverse(glm::lookAt(position, position + direction, up));
}

SceneBuilder::SceneBuilder() {
    material(glm::vec3(0.5f));
}

int SceneBuilder::material(glm::vec3 base_color, float roughness, float metallic, glm::vec3 emissive) {
    Material m;
    m.base_color = glm::vec4(base_color, 1);
    m.roughness = roughness;
    m.metallic = metallic;
    m.emissive = emissive;
    scene.materials.push_back(m);
    return static_cast<int>(scene.materials.size()) - 1;
}

int SceneBuilder::node(const glm::mat4& world) {
    Node n;
    n.translation = glm::vec3(world[3]);
    n.rotation = glm::quat_cast(glm::mat3(world));
    n.world = world;
    scene.nodes.push_back(n);
    return static_cast<int>(scene.nodes.size()) - 1;
}

void SceneBuilder::place(Mesh mesh, glm::vec3 center) {
    for (const Vertex& vertex : mesh.vertices) mesh.bounds.add(vertex.position);
    const int n = node(glm::translate(glm::mat4(1), center));
    scene.nodes[static_cast<std::size_t>(n)].meshes = {static_cast<int>(scene.meshes.size())};
    scene.bounds.add(mesh.bounds.min + center);
    scene.bounds.add(mesh.bounds.max + center);
    scene.meshes.push_back(std::move(mesh));
}

void SceneBuilder::ground(glm::vec3 center, float half_size, int material) {
    Mesh mesh;
    mesh.material = material;
    quad(mesh, glm::vec3(0), {half_size, 0, 0}, {0, 0, -half_size});
    place(std::move(mesh), center);
}

void SceneBuilder::box(glm::vec3 center, glm::vec3 half_size, int material) {
    Mesh mesh;
    mesh.material = material;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0), u(0), v(0);
            n[axis] = side * half_size[axis];
            u[(axis + 1) % 3] = half_size[(axis + 1) % 3] * side;
            v[(axis + 2) % 3] = half_size[(axis + 2) % 3];
            quad(mesh, n, u, v);
        }
    place(std::move(mesh), center);
}

void SceneBuilder::sphere(glm::vec3 center, float radius, int material) {
    Mesh mesh;
    mesh.material = material;
    constexpr std::uint32_t across = 48, down = 24;
    constexpr float pi = std::numbers::pi_v<float>;
    for (std::uint32_t y = 0; y <= down; ++y)
        for (std::uint32_t x = 0; x <= across; ++x) {
            const float a = 2 * pi * static_cast<float>(x) / across, b = pi * static_cast<float>(y) / down;
            const glm::vec3 n(std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a));
            mesh.vertices.push_back({n * radius, n, glm::vec4(std::cos(a), 0, -std::sin(a), 1),
                                     glm::vec2(x, y) / glm::vec2(across, down)});
        }
    for (std::uint32_t y = 0; y < down; ++y)
        for (std::uint32_t x = 0; x < across; ++x) {
            const std::uint32_t i = y * (across + 1) + x, below = i + across + 1;
            for (const std::uint32_t k : {i, below, below + 1, i, below + 1, i + 1}) mesh.indices.push_back(k);
        }
    place(std::move(mesh), center);
}

void SceneBuilder::sun(glm::vec3 direction, glm::vec3 lux, bool shadow) {
    Light light;
    light.type = LightType::sun;
    light.intensity = lux;
    light.shadow = shadow;
    light.node = node(pose(glm::vec3(0), direction));
    scene.lights.push_back(light);
}

Light& SceneBuilder::point(glm::vec3 position, glm::vec3 candela, float range, bool shadow) {
    Light light;
    light.type = LightType::point;
    light.intensity = candela;
    light.range = range;
    light.shadow = shadow;
    light.node = node(pose(position, {0, 0, -1}));
    scene.lights.push_back(light);
    return scene.lights.back();
}

Light& SceneBuilder::spot(glm::vec3 position, glm::vec3 direction, glm::vec3 candela, float range, float outer_cone,
                          bool shadow) {
    Light& light = point(position, candela, range, shadow);
    light.type = LightType::spot;
    light.outer_cone = outer_cone;
    light.inner_cone = 0.5f * outer_cone;
    const glm::mat4 world = pose(position, glm::normalize(direction));
    Node& n = scene.nodes[static_cast<std::size_t>(light.node)];
    n.rotation = glm::quat_cast(glm::mat3(world));
    n.world = world;
    return light;
}

Scene& SceneBuilder::finish() {
    return scene;
}

}  // namespace tyndall::test
