#include "support/box_scene.h"

#include <algorithm>

namespace tyndall {
namespace {

Mesh box_mesh(const TestBox& box) {
    Mesh mesh;
    mesh.name = "box";
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0), u(0), v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1;
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const glm::vec3 unit = normal + u * corner.x + v * corner.y;
                mesh.vertices.push_back({glm::mix(box.min, box.max, unit * 0.5f + 0.5f), normal, glm::vec4(u, 1),
                                         corner * 0.5f + 0.5f});
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
        }
    mesh.bounds = {box.min, box.max};
    return mesh;
}

}  // namespace

Scene box_scene(std::span<const TestBox> boxes) {
    Scene scene;
    scene.materials.emplace_back();
    for (const TestBox& box : boxes) {
        Node node;
        node.meshes = {static_cast<int>(scene.meshes.size())};
        node.dynamic = box.dynamic;
        scene.nodes.push_back(node);
        scene.meshes.push_back(box_mesh(box));
        scene.bounds.add(box.min);
        scene.bounds.add(box.max);
    }
    update_world_transforms(scene);
    return scene;
}

std::size_t add_light(Scene& scene, Light light, glm::vec3 position, glm::vec3 direction) {
    const glm::vec3 forward = glm::normalize(direction);
    const glm::vec3 up = std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    Node node;
    node.translation = position;
    node.rotation = glm::quatLookAt(forward, up);
    light.node = node.light = static_cast<int>(scene.nodes.size());
    node.light = static_cast<int>(scene.lights.size());
    scene.nodes.push_back(node);
    scene.lights.push_back(light);
    update_world_transforms(scene);
    return scene.lights.size() - 1;
}

bool blocked(std::span<const TestBox> boxes, glm::dvec3 a, glm::dvec3 b) {
    return std::ranges::any_of(boxes, [&](const TestBox& box) {
        double enter = 0, leave = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = b[axis] - a[axis];
            if (d == 0 && (a[axis] <= box.min[axis] || a[axis] >= box.max[axis])) return false;
            if (d == 0) continue;
            const double t0 = (box.min[axis] - a[axis]) / d, t1 = (box.max[axis] - a[axis]) / d;
            enter = std::max(enter, std::min(t0, t1));
            leave = std::min(leave, std::max(t0, t1));
        }
        return enter < leave;
    });
}

}  // namespace tyndall
