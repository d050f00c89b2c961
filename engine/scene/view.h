#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace tyndall {

/// A camera pose ready to draw: right-handed, looks along -Z, reversed-Z infinite projection (depth 1 at near, 0 at
/// infinity), clip depth 0..1, y up.
struct View {
    glm::mat4 view{1}, projection{1}, view_projection{1};
    glm::vec3 eye{0};
    float znear = 0.1f;
    float yfov = 1;
    float aspect = 1;
};
[[nodiscard]] View make_view(const glm::mat4& camera_to_world, float yfov, float znear, float aspect);
[[nodiscard]] View look_at(glm::vec3 eye, glm::vec3 target, float yfov, float znear, float aspect);
/// World to view space for an eye that looks along `forward` (unit); exact in direction wherever the eye is.
[[nodiscard]] glm::mat4 world_to_camera(glm::vec3 eye, glm::vec3 forward, glm::vec3 up);
[[nodiscard]] glm::mat4 reversed_infinite_projection(float yfov, float aspect, float znear);

/// Planes with inward normals: dot(plane.xyz, p) + plane.w >= 0 inside.
struct Frustum {
    std::array<glm::vec4, 6> planes;
    int count = 6;
    /// Of any matrix with clip depth 0..1; an infinite far plane is left out.
    static Frustum from(const glm::mat4& view_projection);
    [[nodiscard]] bool intersects(const Aabb& box) const;  ///< conservative
    [[nodiscard]] bool intersects_sphere(glm::vec3 center, float radius) const;
};

}  // namespace tyndall
