#include "reference/surface.h"

#include <algorithm>
#include <cmath>

#include "reference/geometry_impl.h"
#include "reference/surface_texture.h"

namespace tyndall::reference {
namespace {

/// White where the material has no picture.
dvec4 texture(const Scene& scene, int picture, dvec2 uv, bool srgb) {
    return picture < 0 ? dvec4(1) : sample(scene.pictures[static_cast<std::size_t>(picture)], uv, srgb);
}

/// What the vertices carry, at a point of the triangle, in world space.
struct Interpolated {
    dvec3 normal{0}, tangent{0};
    double bitangent_sign = 0;
    dvec2 uv{0};
    dvec4 color{0};
};

Interpolated interpolate(const Geometry::Impl& geometry, const Triangle& triangle, dvec2 barycentric) {
    glm::dmat3 world(geometry.scene.nodes[triangle.node].world);
    double largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(world[i / 3][i % 3]));
    world /= largest;  // its size does not matter to directions
    // Carries normals for any scale; mirroring turns it over, and is turned back.
    const glm::dmat3 cofactor(glm::cross(world[1], world[2]), glm::cross(world[2], world[0]),
                              glm::cross(world[0], world[1]));
    const double handedness = triangle.mirrored ? -1 : 1;
    const double weight[] = {1 - barycentric.x - barycentric.y, barycentric.x, barycentric.y};
    Interpolated at;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vertex& vertex = geometry.vertex(triangle, i);
        at.normal += weight[i] * handedness * (cofactor * dvec3(vertex.normal));
        at.tangent += weight[i] * (world * dvec3(glm::vec3(vertex.tangent)));
        at.bitangent_sign += weight[i] * handedness * vertex.tangent.w;
        at.uv += weight[i] * dvec2(vertex.uv);
        at.color += weight[i] * dvec4(vertex.color);
    }
    return at;
}

dvec3 shading_normal(const Scene& scene, const Material& material, const Interpolated& at, dvec3 geometric) {
    const dvec3 n = glm::length(at.normal) > 1e-6 ? glm::normalize(at.normal) : geometric;
    if (material.normal_picture < 0) return n;
    // The scenes' convention: 128 of 255 is flat.
    dvec3 bump = (255.0 * dvec3(texture(scene, material.normal_picture, at.uv, false)) - 128.0) / 127.0;
    bump.x *= material.normal_scale;
    bump.y *= material.normal_scale;
    const dvec3 across = at.tangent - n * glm::dot(n, at.tangent);
    const double length = glm::length(across);
    if (length <= 1e-6) return n;
    const dvec3 t = across / length;
    return glm::normalize(bump.x * t + bump.y * at.bitangent_sign * glm::cross(n, t) + bump.z * n);
}

/// How far from a surface its own triangles, and those in the same plane, are not asked: corners are in single
/// precision. m.
double skip_at(dvec3 position) {
    const double farthest = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    return 1e-6 * std::max(1.0, farthest);
}

}  // namespace

dvec3 visible(const Geometry& geometry, const Surface& surface, dvec3 to_light, double distance) {
    if (!geometry.impl().shadows) return dvec3(1);
    if (glm::dot(surface.geometric_normal, to_light) <= 0) return dvec3(0);
    const double skip = skip_at(surface.position);
    const dvec3 from = surface.position + skip * surface.geometric_normal;
    if (geometry.occluded(from, to_light, distance, skip)) return dvec3(0);
    return geometry.tint(from, to_light, distance, skip);
}

Surface surface_at(const Scene& scene, const Geometry& geometry, const Geometry::Hit& hit, dvec3 origin,
                   dvec3 unit_direction) {
    const Geometry::Impl& impl = geometry.impl();
    const Triangle& triangle = impl.triangles[hit.triangle];
    const Material& material = impl.material(triangle);
    const Interpolated at = interpolate(impl, triangle, hit.barycentric);

    Surface s;
    s.position = origin + hit.distance * unit_direction;
    const auto& [a, b, c] = triangle.corner;
    s.geometric_normal = glm::normalize(glm::cross(b - a, c - a));
    if (glm::dot(s.geometric_normal, unit_direction) > 0) s.geometric_normal = -s.geometric_normal;
    const double side = hit.front ? 1 : -1;
    s.normal = side * shading_normal(scene, material, at, side * s.geometric_normal);

    s.base_color = dvec3(base_color(scene, material, at.uv, at.color));
    const dvec4 metallic_roughness = texture(scene, material.metallic_roughness_picture, at.uv, false);
    s.roughness = metallic_roughness.g * material.roughness;
    s.metallic = metallic_roughness.b * material.metallic;
    s.occlusion =
        1 + material.occlusion_strength * (texture(scene, material.occlusion_picture, at.uv, false).r - 1);
    s.dielectric_f0 = material.dielectric_f0;
    s.emissive = dvec3(texture(scene, material.emissive_picture, at.uv, true)) * dvec3(material.emissive);
    return s;
}

}  // namespace tyndall::reference
