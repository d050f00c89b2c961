#include "engine/render/sun_cascades.h"

#include <cmath>

#include "engine/core/check.h"
#include "shaders/shared/shadows.h"

namespace tyndall {
namespace {

// Rim of a map in texels, each side: the filter.
constexpr int rim = static_cast<int>(SHADOW_FILTER_RADIUS + 1.5f);

// `center` and `depth_radius` along the rows of `basis`. Double, because a translation far from the origin would
// otherwise lose the fraction of a texel that must stay fixed.
SunMap make_map(const glm::dmat3& rows, glm::dvec3 center, double width, double depth_radius, double texel) {
    const glm::dvec3 scale{1 / width, 1 / width, 0.5 / depth_radius};
    SunMap map;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            map.world_to_texture[column][row] = static_cast<float>(rows[row][column] * scale[row]);
        map.world_to_texture[3][row] = static_cast<float>(0.5 - center[row] * scale[row]);
    }
    map.texel = static_cast<float>(texel);
    return map;
}

// sun_basis as GLM columns = rows of the rotation.
glm::dmat3 rows_of(const glm::mat3& basis) {
    return glm::dmat3(glm::transpose(basis));
}

}  // namespace

std::array<float, SUN_CASCADES> cascade_ends(float near, float far, float lambda) {
    TYNDALL_CHECK_LT(0.0f, near);
    TYNDALL_CHECK_LT(near, far);
    std::array<float, SUN_CASCADES> ends{};
    for (int i = 1; i <= SUN_CASCADES; ++i) {
        const float part = static_cast<float>(i) / SUN_CASCADES;
        ends[i - 1] = lambda * near * std::pow(far / near, part) + (1 - lambda) * (near + (far - near) * part);
    }
    ends.back() = far;
    return ends;
}

glm::mat3 sun_basis(glm::vec3 sun_direction) {
    const glm::vec3 to_sun = -glm::normalize(sun_direction);
    const glm::vec3 up = std::abs(to_sun.y) < 0.999f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 right = glm::normalize(glm::cross(up, to_sun));
    return glm::transpose(glm::mat3(right, glm::cross(to_sun, right), to_sun));
}

// Symbols: k = tangent of the angle between the view axis and the slice's corners. A sphere through the near and
// far corners is centred at (begin + end)(1 + k²)/2; where that is beyond the far end, the far corners alone
// decide.
SliceSphere slice_sphere(float yfov, float aspect, float begin, float end) {
    const float tan_y = std::tan(yfov / 2);
    const float k2 = tan_y * tan_y * (1 + aspect * aspect);
    const float center = 0.5f * (begin + end) * (1 + k2);
    if (center >= end) return {end, end * std::sqrt(k2)};
    return {center, std::sqrt((end - center) * (end - center) + end * end * k2)};
}

SunMap fit_cascade(const View& view, float begin, float end, glm::vec3 sun_direction, int size) {
    TYNDALL_CHECK_LT(2 * rim, size);
    const SliceSphere sphere = slice_sphere(view.yfov, view.aspect, begin, end);
    const double texel = 2.0 * sphere.radius / (size - 2 * rim);
    const glm::vec3 forward = -glm::vec3(view.view[0][2], view.view[1][2], view.view[2][2]);
    const glm::dvec3 world_center = glm::dvec3(view.eye) + glm::dvec3(forward) * double(sphere.center);
    const glm::dmat3 rows = rows_of(sun_basis(sun_direction));
    const int map_size = cascade_map_size(size);
    const double grid = (map_size - size) * texel;
    const glm::dvec3 center = glm::round(world_center * rows / grid) * grid;  // v * M takes dots with columns
    return make_map(rows, center, texel * map_size, sphere.radius + grid, texel);
}

SunMap fit_static(const Aabb& bounds, glm::vec3 sun_direction, int map_size) {
    TYNDALL_CHECK_LT(2 * rim, map_size);
    const Aabb box = bounds.empty() ? Aabb{glm::vec3(-0.5f), glm::vec3(0.5f)} : bounds;
    const glm::dmat3 rows = rows_of(sun_basis(sun_direction));
    const glm::dvec3 half = glm::dvec3(box.max - box.min) * 0.5;
    const glm::dvec3 center = glm::dvec3(box.min) + half;
    glm::dvec3 extent{0};  // half size along the rows
    for (int row = 0; row < 3; ++row) extent[row] = std::max(glm::dot(glm::abs(rows[row]), half), 1e-3);
    const double texel = 2 * std::max(extent.x, extent.y) / (map_size - 2 * rim);
    return make_map(rows, center * rows, texel * map_size, extent.z + texel, texel);
}

glm::mat4 world_to_clip(const SunMap& map) {
    glm::mat4 clip = map.world_to_texture;
    for (int column = 0; column < 4; ++column) {
        const float w = column == 3 ? 1.0f : 0.0f;
        clip[column].x = 2 * clip[column].x - w;
        clip[column].y = 2 * clip[column].y - w;
    }
    return clip;
}

Frustum caster_volume(const SunMap& map) {
    const glm::mat4 rows = glm::transpose(map.world_to_texture);
    Frustum volume;
    volume.planes = {rows[0], rows[3] - rows[0], rows[1], rows[3] - rows[1], rows[2], glm::vec4(0)};
    volume.count = 5;
    for (int i = 0; i < volume.count; ++i) volume.planes[i] /= glm::length(glm::vec3(volume.planes[i]));
    return volume;
}

}  // namespace tyndall
