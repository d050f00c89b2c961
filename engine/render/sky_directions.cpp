#include "engine/render/sky_directions.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/core/check.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/cube_direction.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

/// Point `i` of `count` on the half sphere above the horizon: a spherical Fibonacci lattice.
glm::dvec3 half_sphere(int i, int count) {
    const double y = (i + 0.5) / count, radius = std::sqrt(1 - y * y);
    const double angle = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

std::size_t nearest(std::span<const glm::vec3> directions, glm::vec3 d) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < directions.size(); ++i)
        if (glm::dot(directions[i], d) > glm::dot(directions[best], d)) best = i;
    return best;
}

}  // namespace

std::vector<glm::vec3> sky_directions(int count) {
    TYNDALL_CHECK_LT(4, count);
    const int above = (4 * count + 2) / 5;
    int stride = static_cast<int>(count / std::numbers::phi);
    while (std::gcd(stride, count) != 1) ++stride;
    std::vector<glm::vec3> directions;
    for (int k = 0; k < count; ++k) {
        const int i = static_cast<int>(static_cast<long long>(k) * stride % count);
        const glm::dvec3 d = i < above ? half_sphere(i, above) : half_sphere(i - above, count - above);
        directions.emplace_back(d * glm::dvec3(1, i < above ? 1 : -1, 1));
    }
    return directions;
}

std::vector<SkyLight> share_sky(std::span<const glm::vec4> cube, int size, std::span<const glm::vec3> directions) {
    TYNDALL_CHECK_EQ(cube.size(), static_cast<std::size_t>(6 * size * size));
    std::vector<SkyLight> parts(directions.size(), SkyLight{});
    double whole = 0;
    for (std::size_t i = 0; i < cube.size(); ++i) {
        const int texel = static_cast<int>(i);
        const glm::vec3 axis =
            glsl::cube_axis_direction({texel % size, texel / size % size, texel / (size * size)}, size);
        // A texel at the distance r from the cube's centre covers (2 / size)² / r³.
        const float r2 = glm::dot(axis, axis), weight = 1 / (r2 * std::sqrt(r2));
        const glm::vec3 d = axis / std::sqrt(r2);
        SkyLight& part = parts[nearest(directions, d)];
        for (int c = 0; c < 3; ++c) part[static_cast<std::size_t>(c)] += weight * cube[i][c] * glm::vec4(1, 3.0f * d);
        whole += weight;
    }
    for (SkyLight& part : parts)
        for (glm::vec4& channel : part) channel /= static_cast<float>(whole);
    return parts;
}

SkyLight sum(std::span<const SkyLight> parts) {
    SkyLight all{};
    for (const SkyLight& part : parts)
        for (std::size_t c = 0; c < all.size(); ++c) all[c] += part[c];
    return all;
}

}  // namespace tyndall
