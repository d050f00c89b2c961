#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "engine/scene/scene.h"

namespace tyndall::reference::test {

/// Builds scenes by hand: one node in the world's own coordinates for every mesh.
struct SceneOfTriangles {
    Scene scene;

    SceneOfTriangles() { scene.materials.emplace_back().double_sided = true; }
    Mesh& mesh(int material = 0) {
        scene.meshes.emplace_back().material = material;
        scene.nodes.emplace_back().meshes = {static_cast<int>(scene.meshes.size()) - 1};
        return scene.meshes.back();
    }
    static void triangle(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const glm::vec3 corners[] = {a, b, c};
        const glm::vec2 uv[] = {{0, 0}, {1, 0}, {0, 1}};
        for (int i = 0; i < 3; ++i) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back({corners[i], normal, glm::vec4(glm::normalize(b - a), 1), uv[i]});
        }
    }
    /// A parallelogram with texture coordinates (0, 0) at `corner`, (1, 0) at corner + u and (0, 1) at corner + v.
    static void quad(Mesh& mesh, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const glm::vec3 normal = glm::normalize(glm::cross(u, v));
        for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
            mesh.vertices.push_back({corner + at.x * u + at.y * v, normal, glm::vec4(glm::normalize(u), 1), at});
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    }
    /// Faces outwards.
    static void box(Mesh& mesh, glm::vec3 low, glm::vec3 high) {
        const glm::vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
        quad(mesh, low, y, x);
        quad(mesh, low, x, z);
        quad(mesh, low, z, y);
        quad(mesh, high, -x, -y);
        quad(mesh, high, -z, -x);
        quad(mesh, high, -y, -z);
    }
    /// Inscribed: corners lie on the sphere. `rings` from pole to pole, twice as many around.
    static void sphere(Mesh& mesh, glm::vec3 center, float radius, int rings) {
        const auto at = [&](int i, int j) {
            const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * j / rings;
            return center + radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                               std::sin(theta) * std::sin(phi));
        };
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < 2 * rings; ++j) {
                if (i > 0) triangle(mesh, at(i, j), at(i, j + 1), at(i + 1, j));
                if (i + 1 < rings) triangle(mesh, at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
            }
    }
};

}  // namespace tyndall::reference::test
