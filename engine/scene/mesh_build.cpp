#include "engine/scene/mesh_build.h"

#include <cmath>

namespace tyndall {
namespace {

/// A unit vector orthogonal to the unit vector n: crossed with the axis it is least along.
glm::vec3 orthogonal(glm::vec3 n) {
    const glm::vec3 a = glm::abs(n);
    const glm::vec3 axis = a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0)
                           : a.y <= a.z             ? glm::vec3(0, 1, 0)
                                                    : glm::vec3(0, 0, 1);
    return glm::normalize(glm::cross(n, axis));
}

glm::vec3 normalised_or_up(glm::vec3 v) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::vec3(0, 1, 0);
}

}  // namespace

std::vector<std::uint32_t> triangles_of_strip(const std::vector<std::uint32_t>& strip) {
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 2; i < strip.size(); ++i) {
        const std::size_t odd = i & 1;
        triangles.insert(triangles.end(), {strip[i - 2], strip[i - 1 + odd], strip[i - odd]});
    }
    return triangles;
}

std::vector<std::uint32_t> triangles_of_fan(const std::vector<std::uint32_t>& fan) {
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 2; i < fan.size(); ++i) triangles.insert(triangles.end(), {fan[i - 1], fan[i], fan[0]});
    return triangles;
}

void normalise_normals(Mesh& mesh) {
    for (Vertex& v : mesh.vertices) v.normal = normalised_or_up(v.normal);
}

void make_flat(Mesh& mesh) {
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) vertices.push_back(mesh.vertices[index]);
    for (std::size_t i = 0; i + 2 < vertices.size(); i += 3) {
        const glm::vec3 a = vertices[i].position;
        const glm::vec3 normal =
            normalised_or_up(glm::cross(vertices[i + 1].position - a, vertices[i + 2].position - a));
        for (std::size_t k = i; k < i + 3; ++k) {
            vertices[k].normal = normal;
            mesh.indices[k] = static_cast<std::uint32_t>(k);
        }
    }
    mesh.vertices = std::move(vertices);
}

// In a triangle with edges e1, e2 and uv edges d1, d2: position = p0 + T u + B v, so
// T = (e1 d2.v - e2 d1.v) / det, B = (e2 d1.u - e1 d2.u) / det, det = d1.u d2.v - d2.u d1.v.
// In glTF v runs down the picture and green of a normal map points up it: the bitangent is -B.
void compute_tangents(Mesh& mesh) {
    std::vector<glm::vec3> tangents(mesh.vertices.size(), glm::vec3(0));
    std::vector<glm::vec3> bitangents(mesh.vertices.size(), glm::vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Vertex& a = mesh.vertices[mesh.indices[i]];
        const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
        const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
        const glm::vec3 e1 = b.position - a.position, e2 = c.position - a.position;
        const glm::vec2 d1 = b.uv - a.uv, d2 = c.uv - a.uv;
        // Only the sign of det matters to a direction; the length left in weights large triangles more.
        const float sign = d1.x * d2.y - d2.x * d1.y < 0 ? -1.0f : 1.0f;
        for (std::size_t k = i; k < i + 3; ++k) {
            tangents[mesh.indices[k]] += sign * (e1 * d2.y - e2 * d1.y);
            bitangents[mesh.indices[k]] -= sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& v = mesh.vertices[i];
        const glm::vec3 t = tangents[i] - v.normal * glm::dot(v.normal, tangents[i]);
        const float length = glm::length(t);
        const bool usable = length > 1e-20f && std::isfinite(length);
        const float sign = glm::dot(glm::cross(v.normal, t), bitangents[i]) < 0 ? -1.0f : 1.0f;
        v.tangent = usable ? glm::vec4(t / length, sign) : glm::vec4(orthogonal(v.normal), 1);
    }
}

void make_arbitrary_tangents(Mesh& mesh) {
    for (Vertex& v : mesh.vertices) v.tangent = glm::vec4(orthogonal(v.normal), 1);
}

}  // namespace tyndall
