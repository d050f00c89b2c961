#include "tools/grids/noise3.h"

#include <algorithm>
#include <cmath>

#include "tools/modeling/random.h"

namespace tyndall::grid_models {
namespace {

std::uint32_t hash_cell(const glm::ivec3& cell, std::uint32_t seed) {
    using modeling::hash;
    return hash(std::uint32_t(cell.x) + hash(std::uint32_t(cell.y) + hash(std::uint32_t(cell.z) + hash(seed))));
}

/// One of the 12 directions to the middles of a cube's edges.
float along_gradient(const glm::ivec3& cell, const glm::vec3& from, std::uint32_t seed) {
    const std::uint32_t h = hash_cell(cell, seed) >> 8U;
    const float u = h % 3 == 0 ? from.y : from.x, v = h % 3 == 2 ? from.y : from.z;
    return ((h >> 4U) % 2 == 0 ? u : -u) + ((h >> 5U) % 2 == 0 ? v : -v);
}

}  // namespace

float gradient_noise(glm::vec3 p, std::uint32_t seed) {
    const glm::vec3 low = glm::floor(p), f = p - low;
    const glm::ivec3 cell(low);
    const glm::vec3 w = f * f * f * (f * (f * 6.0F - 15.0F) + 10.0F);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 share = glm::mix(1.0F - w, w, glm::vec3(step));
        sum += share.x * share.y * share.z * along_gradient(cell + step, f - glm::vec3(step), seed);
    }
    return sum;
}

float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed) {
    float sum = 0, strength = 1;
    for (int octave = 0; octave < octaves; ++octave, p *= 2.0F, strength *= 0.5F)
        sum += strength * gradient_noise(p, seed + std::uint32_t(octave));
    return sum;
}

float billows(glm::vec3 p, std::uint32_t seed) {
    const glm::ivec3 cell(glm::floor(p));
    float nearest = 1;  // squared
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const glm::ivec3 at = cell + glm::ivec3(x, y, z);
                const std::uint32_t h = hash_cell(at, seed);
                const glm::vec3 point =
                    glm::vec3(at) + glm::vec3(modeling::unit_float(h), modeling::unit_float(modeling::hash(h + 1)),
                                              modeling::unit_float(modeling::hash(h + 2)));
                const glm::vec3 away = point - p;
                nearest = std::min(nearest, away.x * away.x + away.y * away.y + away.z * away.z);
            }
    return 1 - std::sqrt(nearest);
}

}  // namespace tyndall::grid_models
