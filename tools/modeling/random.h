// Numbers that are the same on every machine: integer hashes and value noise, no std distributions. Transcendental
// functions go through double and are rounded, so that last-bit differences between maths libraries vanish.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace tyndall::modeling {

constexpr float kPi = 3.14159265358979f;

inline float sine(float x) {
    return static_cast<float>(std::sin(static_cast<double>(x)));
}
inline float cosine(float x) {
    return static_cast<float>(std::cos(static_cast<double>(x)));
}
inline float arctangent(float y, float x) {
    return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float arcsine(float x) {
    return static_cast<float>(std::asin(static_cast<double>(x)));
}
inline float power(float x, float y) {
    return static_cast<float>(std::pow(static_cast<double>(x), static_cast<double>(y)));
}

// Integer finaliser with full avalanche (two multiply-xorshift rounds).
inline uint32_t hash(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    x ^= x >> 16;
    return x;
}

// [0,1) from the top 24 bits, so that the float is exact.
inline float unit_float(uint32_t bits) {
    return static_cast<float>(bits >> 8) * (1.0f / 16777216.0f);
}

inline float hash_float(int x, int y, uint32_t seed) {
    return unit_float(hash(static_cast<uint32_t>(x) + hash(static_cast<uint32_t>(y) + hash(seed))));
}

// Sequence of random numbers: a Weyl counter through `hash`.
class Random {
  public:
    explicit Random(uint32_t seed) : state_(hash(seed)) {}
    float unit() {
        state_ += 0x9e3779b9U;
        return unit_float(hash(state_));
    }
    float range(float low, float high) { return low + (high - low) * unit(); }
    int index(int count) { return static_cast<int>(unit() * static_cast<float>(count)); }

  private:
    uint32_t state_;
};

// x in [0, period); unchanged where the period is 0.
int wrapped(int x, int period);

// Value noise in [0,1], smooth, repeating every period.x by period.y cells (0: never).
float value_noise(glm::vec2 p, glm::ivec2 period, uint32_t seed);

// Sum of `octaves` value noises, each twice as fine and half as strong, in [0,1].
float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, uint32_t seed);

}  // namespace tyndall::modeling
