#include "engine/scene/view.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall {
namespace {

View from_pose(glm::vec3 eye, glm::vec3 forward, glm::vec3 up, float yfov, float znear, float aspect) {
    View view;
    view.view = world_to_camera(eye, forward, up);
    view.projection = reversed_infinite_projection(yfov, aspect, znear);
    view.view_projection = view.projection * view.view;
    view.eye = eye;
    view.znear = znear;
    view.yfov = yfov;
    view.aspect = aspect;
    return view;
}

}  // namespace

glm::mat4 world_to_camera(glm::vec3 eye, glm::vec3 forward, glm::vec3 up) {
    // Not lookAt(eye, eye + forward, up): a million metres from the origin that sum holds 4 bits of the direction.
    return glm::translate(glm::lookAt(glm::vec3(0), forward, up), -eye);
}

// Clip z = near, clip w = -z of view space: depth = near / distance, 1 at the near plane, 0 at infinity.
glm::mat4 reversed_infinite_projection(float yfov, float aspect, float znear) {
    const float f = 1.0f / std::tan(yfov * 0.5f);
    glm::mat4 p(0.0f);
    p[0][0] = f / aspect;
    p[1][1] = f;
    p[2][3] = -1.0f;
    p[3][2] = znear;
    return p;
}

View make_view(const glm::mat4& camera_to_world, float yfov, float znear, float aspect) {
    return from_pose(glm::vec3(camera_to_world[3]), -glm::normalize(glm::vec3(camera_to_world[2])),
                     glm::normalize(glm::vec3(camera_to_world[1])), yfov, znear, aspect);
}

View look_at(glm::vec3 eye, glm::vec3 target, float yfov, float znear, float aspect) {
    const glm::vec3 offset = target - eye;
    const glm::vec3 forward = glm::dot(offset, offset) > 0 ? glm::normalize(offset) : glm::vec3(0, 0, -1);
    const glm::vec3 up = std::abs(forward.y) < 0.9999f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1);
    return from_pose(eye, forward, up, yfov, znear, aspect);
}

// A point is inside where -w <= x <= w, -w <= y <= w and 0 <= z <= w, and each clip coordinate is a row of the
// matrix times the point: each plane is a sum or difference of rows (Gribb and Hartmann 2001).
Frustum Frustum::from(const glm::mat4& view_projection) {
    const glm::mat4 rows = glm::transpose(view_projection);
    const glm::vec4 candidates[] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                    rows[3] - rows[1], rows[3] - rows[2], rows[2]};
    Frustum frustum;
    frustum.count = 0;
    for (const glm::vec4& plane : candidates) {
        const float length = glm::length(glm::vec3(plane));
        if (length < 1e-10f) continue;  // 0 z + near >= 0: infinitely far
        frustum.planes[static_cast<std::size_t>(frustum.count++)] = plane / length;
    }
    return frustum;
}

bool Frustum::intersects(const Aabb& box) const {
    if (box.empty()) return false;
    const glm::vec3 center = (box.min + box.max) * 0.5f;
    const glm::vec3 extent = (box.max - box.min) * 0.5f;
    for (int i = 0; i < count; ++i) {
        const glm::vec4& plane = planes[static_cast<std::size_t>(i)];
        const glm::vec3 normal(plane);
        if (glm::dot(normal, center) + glm::dot(glm::abs(normal), extent) + plane.w < 0) return false;
    }
    return true;
}

bool Frustum::intersects_sphere(glm::vec3 center, float radius) const {
    for (int i = 0; i < count; ++i) {
        const glm::vec4& plane = planes[static_cast<std::size_t>(i)];
        if (glm::dot(glm::vec3(plane), center) + plane.w < -radius) return false;
    }
    return true;
}

}  // namespace tyndall
