// Triangle meshes under construction: vertices grouped by material.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tools/modeling/materials.h"

namespace tyndall::modeling {

using glm::mat4;
using glm::quat;
using glm::vec2;
using glm::vec3;
using glm::vec4;

struct Vertex {
    vec3 position;
    vec3 normal;
    vec2 uv;
};

struct Primitive {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
};

// Positions are put through `transform` as they are added; it must be a rotation, a translation and at most a
// uniform scale. Texture coordinates of flat faces come from a planar projection at the material's texel density.
struct Mesh {
    std::string name;
    std::map<Surface, Primitive> parts;
    mat4 transform{1.0f};

    // Convex, flat, counter-clockwise seen from outside.
    void polygon(Surface surface, std::span<const vec3> points);
    void quad(Surface surface, vec3 a, vec3 b, vec3 c, vec3 d);
    void triangle(Surface surface, vec3 a, vec3 b, vec3 c);
    // The same with given texture coordinates, already in tiles.
    void quad_uv(Surface surface, const std::array<vec3, 4>& p, const std::array<vec2, 4>& uv);
    // rows x columns vertices, row-major; seen from outside, columns run right and rows run up.
    void grid(Surface surface, int rows, int columns, std::span<const Vertex> vertices);
    void append(const Mesh& other, const mat4& placement);
    [[nodiscard]] size_t triangles() const;
};

// In-plane axes of the planar projection for a unit normal: u runs right, v runs up as seen from outside.
void planar_axes(vec3 normal, vec3& u, vec3& v);

// One tangent per vertex, xyz orthogonal to the normal and w the handedness of glTF, from the texture coordinates.
std::vector<vec4> tangents(const Primitive& primitive);

}  // namespace tyndall::modeling
