#include "tools/modeling/random.h"

namespace tyndall::modeling {

using glm::ivec2;
using glm::vec2;

int wrapped(int x, int period) {
    return period > 0 ? ((x % period) + period) % period : x;
}

float value_noise(vec2 p, ivec2 period, uint32_t seed) {
    const vec2 cell = glm::floor(p), f = p - cell, s = f * f * (3.0f - 2.0f * f);
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
    auto corner = [&](int i, int j) {
        return hash_float(wrapped(x + i, period.x), wrapped(y + j, period.y), seed);
    };
    return glm::mix(glm::mix(corner(0, 0), corner(1, 0), s.x), glm::mix(corner(0, 1), corner(1, 1), s.x), s.y);
}

float fractal_noise(vec2 p, ivec2 period, int octaves, uint32_t seed) {
    float sum = 0.0f, weight = 0.5f, total = 0.0f;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * value_noise(p, period, seed + static_cast<uint32_t>(i) * 101U);
        total += weight;
        weight *= 0.5f;
        p *= 2.0f;
        period *= 2;
    }
    return sum / total;
}

}  // namespace tyndall::modeling
