#include "reference/media_noise.h"

#include <algorithm>
#include <cstddef>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/media_density.glsl"
TYNDALL_GLSL_END

namespace tyndall::reference {
namespace {

// Nearly all time of a picture with noisy media goes here. Eight points at once are four times as fast as one.
#pragma GCC push_options
#pragma GCC target("avx2")

constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Uints = unsigned __attribute__((vector_size(4 * lanes)));
using Ints = int __attribute__((vector_size(4 * lanes)));
#define INLINED [[gnu::always_inline]] inline

struct Points {
    Floats x, y, z;
};

// PCG's output of one step of its generator.
INLINED void hash(Uints& x) {
    const Uints state = x * 747796405u + 2891336453u;
    const Uints word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    x = (word >> 22u) ^ word;
}

INLINED void hash_sum(const Uints& a, const Uints& b, Uints& result) {
    result = a + b;
    hash(result);
}

// p . one of the 12 directions to the edges of a cube: two of its coordinates, each with a sign.
INLINED void gradient(const Uints& corner, const Floats& x, const Floats& y, const Floats& z, Floats& result) {
    const Uints direction = ((corner >> 16u) * 12u) >> 16u;
    const Uints axis = direction >> 2u;
    const Floats a = axis == 0u ? y : x;
    const Floats b = axis == 2u ? y : z;
    result = ((direction & 1u) == 0u ? a : -a) + ((direction & 2u) == 0u ? b : -b);
}

INLINED void mix(const Floats& a, const Floats& b, const Floats& weight, Floats& result) {
    result = a * (1.0f - weight) + b * weight;
}

INLINED void cell_of(const Floats& p, Floats& within, Floats& weight, Uints& cell) {
    Ints whole = __builtin_convertvector(p, Ints);
    whole += __builtin_convertvector(whole, Floats) > p;  // true is -1
    within = p - __builtin_convertvector(whole, Floats);
    weight = within * within * within * (within * (within * 6.0f - 15.0f) + 10.0f);
    cell = __builtin_convertvector(whole, Uints);
}

INLINED void gradient_noise(const Points& p, unsigned seed, Floats& noise) {
    Floats fx, fy, fz, wx, wy, wz;
    Uints cx, cy, cz, seeded = Uints{} + seed;
    cell_of(p.x, fx, wx, cx);
    cell_of(p.y, fy, wy, cy);
    cell_of(p.z, fz, wz, cz);
    hash(seeded);
    Floats over_z[2];
    for (unsigned k = 0; k < 2; ++k) {
        const Floats z = k == 0 ? fz : fz - 1.0f;
        Uints plane;
        hash_sum(cz + k, seeded, plane);
        Floats over_y[2];
        for (unsigned j = 0; j < 2; ++j) {
            const Floats y = j == 0 ? fy : fy - 1.0f;
            Uints row, left, right;
            hash_sum(cy + j, plane, row);
            hash_sum(cx, row, left);
            hash_sum(cx + 1u, row, right);
            Floats a, b;
            gradient(left, fx, y, z, a);
            gradient(right, fx - 1.0f, y, z, b);
            mix(a, b, wx, over_y[j]);
        }
        mix(over_y[0], over_y[1], wy, over_z[k]);
    }
    mix(over_z[0], over_z[1], wz, noise);
}

INLINED void clamp_to_unit(Floats& v) {
    const Floats zero{}, one = zero + 1.0f;
    v = v < zero ? zero : v;
    v = v > one ? one : v;
}

// mix(1, 2 clamp(0.5 + 3 (fbm - 0.5), 0, 1), amount), fbm of four octaves.
void factors_of(const MediaNoise& noise, const Points& points, Floats& factors) {
    Points p{points.x / noise.scale, points.y / noise.scale, points.z / noise.scale};
    Floats sum{};
    float amplitude = 1, total = 0;
    for (unsigned octave = 0; octave < 4; ++octave) {
        Floats one;
        gradient_noise(p, noise.seed + octave, one);
        sum += amplitude * one;
        total += amplitude;
        amplitude *= 0.5f;
        p = {2.0f * p.x + 0.37f, 2.0f * p.y + 0.61f, 2.0f * p.z + 0.23f};
    }
    Floats fbm = 0.5f + 0.5f * sum / total;
    clamp_to_unit(fbm);
    Floats contrast = 0.5f + 3.0f * (fbm - 0.5f);
    clamp_to_unit(contrast);
    factors = (1.0f - noise.amount) + 2.0f * contrast * noise.amount;
}

void factors_by_lanes(const MediaNoise& noise, std::span<const glm::vec3> points, std::span<float> factors) {
    for (std::size_t first = 0; first < points.size(); first += lanes) {
        const std::size_t count = std::min<std::size_t>(lanes, points.size() - first);
        Points p{};
        for (std::size_t i = 0; i < count; ++i) {
            p.x[i] = points[first + i].x;
            p.y[i] = points[first + i].y;
            p.z[i] = points[first + i].z;
        }
        Floats result;
        factors_of(noise, p, result);
        for (std::size_t i = 0; i < count; ++i) factors[first + i] = result[i];
    }
}

#undef INLINED
#pragma GCC pop_options

}  // namespace

void MediaNoise::factors(std::span<const glm::vec3> points, std::span<float> factors) const {
    static const bool has_lanes = __builtin_cpu_supports("avx2");
    if (has_lanes) return factors_by_lanes(*this, points, factors);
    std::transform(points.begin(), points.end(), factors.begin(),
                   [&](glm::vec3 p) { return glsl::media_noise(p, scale, amount, seed); });
}

float MediaNoise::factor(glm::vec3 point) const {
    return glsl::media_noise(point, scale, amount, seed);
}

}  // namespace tyndall::reference
