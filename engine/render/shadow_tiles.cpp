#include "engine/render/shadow_tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "engine/render/lamps.h"
#include "engine/render/sun_cascades.h"
#include "shaders/shared/shadows.h"

namespace tyndall {
namespace {

constexpr float nearest_caster = 0.02f;        // m
constexpr float widest_half_angle = 1.39626f;  // 80°

int clamped_size(int level, int size_max) {
    constexpr int lowest = std::countr_zero(static_cast<unsigned>(smallest_shadow_tile));
    const int highest = std::countr_zero(static_cast<unsigned>(size_max));
    return 1 << std::clamp(level, lowest, highest);
}

// Distances d along the axis, w = d: z/w = near (far - d) / ((far - near) d), 1 at near and 0 at far.
glm::mat4 reversed_projection(float tan_half, float near, float far) {
    const float a = near / (far - near);
    glm::mat4 m(0);
    m[0][0] = m[1][1] = 1 / tan_half;
    m[2][2] = a;
    m[3][2] = a * far;
    m[2][3] = -1;
    return m;
}

glm::vec4 rect_of(const AtlasTile& place, int atlas_size) {
    const auto atlas = static_cast<float>(atlas_size);
    return {glm::vec2(place.origin) / atlas, static_cast<float>(place.size) / atlas, 0.5f / atlas};
}

}  // namespace

int shadow_tile_count(LightType type) {
    switch (type) {
        case LightType::point:
            return 6;
        case LightType::spot:
        case LightType::sun:
            return 1;
    }
    return 0;
}

int shadow_tile_level(float range, float distance, int size_max, int previous) {
    const float exact = std::log2(static_cast<float>(size_max) * range / std::max(distance, 0.1f));
    if (previous >= 0 && std::abs(exact - static_cast<float>(previous)) < 0.75f) return previous;
    return std::max(static_cast<int>(std::lround(exact)), 0);
}

std::vector<int> plan_tile_sizes(std::span<const TileDemand> demands, int size_max, long long area) {
    std::vector<std::size_t> order(demands.size());  // most important first
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](auto a, auto b) { return demands[a].level > demands[b].level; });

    const auto area_of = [&](std::size_t i, int size) {
        return static_cast<long long>(demands[i].tiles) * size * size;
    };
    std::vector<int> sizes(demands.size());
    long long used = 0;
    int halvings = 0;
    for (;; ++halvings) {
        used = 0;
        bool all_smallest = true;
        for (std::size_t i = 0; i < demands.size(); ++i) {
            sizes[i] = clamped_size(demands[i].level - halvings, size_max);
            used += area_of(i, sizes[i]);
            all_smallest = all_smallest && sizes[i] == smallest_shadow_tile;
        }
        if (used <= area || all_smallest) break;
    }
    for (auto i = order.rbegin(); i != order.rend() && used > area; ++i) {
        used -= area_of(*i, sizes[*i]);
        sizes[*i] = 0;
    }
    if (halvings == 0) return sizes;
    for (const std::size_t i : order) {
        const int larger = clamped_size(demands[i].level - halvings + 1, size_max);
        const long long more = area_of(i, larger) - area_of(i, sizes[i]);
        if (sizes[i] == 0 || used + more > area) continue;
        used += more;
        sizes[i] = larger;
    }
    return sizes;
}

shared::ShadowTile make_shadow_tile(const Light& light, const glm::mat4& pose, int face, const AtlasTile& place,
                                    int atlas_size) {
    const glm::vec3 position(pose[3]);
    glm::vec3 axis(0);
    float tan_half = 1;
    if (light.type == LightType::point) {
        axis[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
    } else {
        axis = -glm::vec3(pose[2]);
        tan_half = std::tan(std::clamp(light.outer_cone, 0.01f, widest_half_angle));
    }
    const auto side = static_cast<float>(place.size);
    tan_half *= side / (side - 2 * SHADOW_TILE_BORDER);

    const float near = std::max(light.radius, nearest_caster);
    const float far = std::max(light.range, 2 * near);
    const glm::vec3 up = std::abs(axis.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    shared::ShadowTile tile;
    tile.world_to_clip = reversed_projection(tan_half, near, far) * world_to_camera(position, axis, up);
    tile.rect = rect_of(place, atlas_size);
    tile.depth = glm::vec4(near, far, 2 * tan_half / side, 1);
    return tile;
}

shared::ShadowTile make_sun_tile(const Aabb& bounds, const glm::mat4& light_to_world, const AtlasTile& place,
                                 int atlas_size) {
    const SunMap map = fit_static(bounds, -glm::vec3(light_to_world[2]), place.size);
    shared::ShadowTile tile;
    tile.world_to_clip = sun_distance * world_to_clip(map);
    tile.rect = rect_of(place, atlas_size);
    tile.depth = glm::vec4(0, sun_distance, map.texel / sun_distance, 1);
    return tile;
}

}  // namespace tyndall
