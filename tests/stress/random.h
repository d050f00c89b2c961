#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <numbers>
#include <string_view>

namespace tyndall::stress {

/// Numbers that are a pure function of a seed and a path of keys, the same on every machine (splitmix64, Steele et
/// al. 2014).
class Random {
  public:
    explicit Random(std::initializer_list<std::uint64_t> path) {
        for (const std::uint64_t key : path) state_ = mix(state_ + key + increment);
    }
    /// Another stream, by name: what one draws does not shift the others.
    [[nodiscard]] Random fork(std::string_view name) const {
        std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
        for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
        return Random{state_, hash};
    }
    std::uint64_t bits() { return mix(state_ += increment); }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< in [0, 1)
    double linear(double low, double high) { return low + (high - low) * unit(); }
    double logarithmic(double low, double high) { return low * std::pow(high / low, unit()); }
    bool chance(double p) { return unit() < p; }
    int below(int count) { return static_cast<int>(unit() * count); }
    template <class T>
    T pick(std::initializer_list<T> values) {
        return values.begin()[below(static_cast<int>(values.size()))];
    }
    glm::vec3 box(double half) { return {linear(-half, half), linear(-half, half), linear(-half, half)}; }
    /// Uniform over the sphere.
    glm::vec3 direction() {
        const double y = linear(-1, 1), angle = linear(0, 2 * std::numbers::pi), r = std::sqrt(1 - y * y);
        return {r * std::cos(angle), y, r * std::sin(angle)};
    }

  private:
    static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15ULL;
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    std::uint64_t state_ = 0;
};

}  // namespace tyndall::stress
