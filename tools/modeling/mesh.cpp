#include "tools/modeling/mesh.h"

#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::modeling {

void planar_axes(vec3 normal, vec3& u, vec3& v) {
    if (std::abs(normal.y) > 0.94f) {
        u = glm::normalize(vec3(1, 0, 0) - normal * normal.x);
    } else {
        u = glm::normalize(glm::cross(vec3(0, 1, 0), normal));
    }
    v = glm::cross(normal, u);
}

void Mesh::polygon(Surface surface, std::span<const vec3> points) {
    vec3 area(0.0f);
    std::vector<vec3> p(points.size());
    for (size_t i = 0; i < p.size(); ++i) p[i] = vec3(transform * vec4(points[i], 1.0f));
    for (size_t i = 1; i + 1 < p.size(); ++i) area += glm::cross(p[i] - p[0], p[i + 1] - p[0]);
    const float length = glm::length(area);
    if (length < 1e-7f) return;
    const vec3 normal = area / length;
    vec3 u, v;
    planar_axes(normal, u, v);
    const float scale = 1.0f / surface.tile_metres;
    Primitive& part = parts[surface];
    const auto base = static_cast<uint32_t>(part.vertices.size());
    for (const vec3& x : p) part.vertices.push_back({x, normal, vec2(glm::dot(x, u), -glm::dot(x, v)) * scale});
    for (uint32_t i = 1; i + 1 < p.size(); ++i)
        part.indices.insert(part.indices.end(), {base, base + i, base + i + 1});
}

void Mesh::quad(Surface surface, vec3 a, vec3 b, vec3 c, vec3 d) {
    polygon(surface, std::array{a, b, c, d});
}

void Mesh::triangle(Surface surface, vec3 a, vec3 b, vec3 c) {
    polygon(surface, std::array{a, b, c});
}

void Mesh::quad_uv(Surface surface, const std::array<vec3, 4>& p, const std::array<vec2, 4>& uv) {
    const vec3 normal = glm::normalize(glm::mat3(transform) * glm::cross(p[1] - p[0], p[3] - p[0]));
    Primitive& part = parts[surface];
    const auto base = static_cast<uint32_t>(part.vertices.size());
    for (size_t i = 0; i < 4; ++i) part.vertices.push_back({vec3(transform * vec4(p[i], 1.0f)), normal, uv[i]});
    part.indices.insert(part.indices.end(), {base, base + 1, base + 2, base, base + 2, base + 3});
}

void Mesh::grid(Surface surface, int rows, int columns, std::span<const Vertex> vertices) {
    Primitive& part = parts[surface];
    const auto base = static_cast<uint32_t>(part.vertices.size());
    for (const Vertex& x : vertices) {
        part.vertices.push_back(
            {vec3(transform * vec4(x.position, 1.0f)), glm::normalize(glm::mat3(transform) * x.normal), x.uv});
    }
    for (int r = 0; r + 1 < rows; ++r) {
        for (int c = 0; c + 1 < columns; ++c) {
            const uint32_t a = base + static_cast<uint32_t>(r * columns + c);
            const uint32_t b = a + 1, d = a + static_cast<uint32_t>(columns), e = d + 1;
            auto solid = [&](uint32_t i, uint32_t j, uint32_t k) {
                const vec3 x = part.vertices[i].position, y = part.vertices[j].position,
                           z = part.vertices[k].position;
                if (glm::length(glm::cross(y - x, z - x)) > 1e-8f)
                    part.indices.insert(part.indices.end(), {i, j, k});
            };
            solid(a, b, e);
            solid(a, e, d);
        }
    }
}

void Mesh::append(const Mesh& other, const mat4& placement) {
    const mat4 m = transform * placement;
    for (const auto& [surface, from] : other.parts) {
        Primitive& to = parts[surface];
        const auto base = static_cast<uint32_t>(to.vertices.size());
        for (const Vertex& x : from.vertices) {
            to.vertices.push_back(
                {vec3(m * vec4(x.position, 1.0f)), glm::normalize(glm::mat3(m) * x.normal), x.uv});
        }
        for (const uint32_t i : from.indices) to.indices.push_back(base + i);
    }
}

size_t Mesh::triangles() const {
    size_t count = 0;
    for (const auto& [surface, part] : parts) count += part.indices.size() / 3;
    return count;
}

std::vector<vec4> tangents(const Primitive& primitive) {
    const auto& v = primitive.vertices;
    std::vector<vec3> along_u(v.size(), vec3(0.0f)), along_v(v.size(), vec3(0.0f));
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
        const uint32_t a = primitive.indices[i], b = primitive.indices[i + 1], c = primitive.indices[i + 2];
        const vec3 e1 = v[b].position - v[a].position, e2 = v[c].position - v[a].position;
        const vec2 d1 = v[b].uv - v[a].uv, d2 = v[c].uv - v[a].uv;
        const float determinant = d1.x * d2.y - d1.y * d2.x;
        if (std::abs(determinant) < 1e-12f) continue;
        const vec3 du = (e1 * d2.y - e2 * d1.y) / determinant, dv = (e2 * d1.x - e1 * d2.x) / determinant;
        for (const uint32_t k : {a, b, c}) {
            along_u[k] += du;
            along_v[k] += dv;
        }
    }
    std::vector<vec4> result(v.size());
    for (size_t i = 0; i < v.size(); ++i) {
        const vec3 n = v[i].normal;
        vec3 t = along_u[i] - n * glm::dot(n, along_u[i]);
        if (glm::length(t) < 1e-9f) {
            vec3 unused;
            planar_axes(n, t, unused);
        }
        t = glm::normalize(t);
        // Image rows run down, the bitangent runs up.
        result[i] = vec4(t, glm::dot(glm::cross(n, t), along_v[i]) > 0.0f ? -1.0f : 1.0f);
    }
    return result;
}

}  // namespace tyndall::modeling
