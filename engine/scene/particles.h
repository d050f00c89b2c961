#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tyndall {

/// A source of soft particles: node extras.particles. Lengths and directions are of the node's frame, which it
/// moves as a whole; radii are of the world's.
struct ParticleEmitter {
    static constexpr int most = 4096;  ///< of one emitter
    int node = -1;
    int count = 64;                  ///< alive at any time, 1 to `most`
    float lifetime = 4;              ///< s
    float size = 0.2f;               ///< m, radius at birth
    float growth = 0;                ///< m/s, of the radius
    glm::vec3 extent{0};             ///< m: born in a ball of these radii
    glm::vec3 velocity{0, 0.5f, 0};  ///< m/s at birth
    glm::vec3 acceleration{0};       ///< m/s²
    float spread = 0.1f;             ///< m/s: radius of the ball of velocities added to it
    glm::vec3 color{0.5f};           ///< share of light that is scattered, 0 to 1
    float opacity = 0.5f;            ///< in the middle of a particle half way through its life, 0 to 1
    glm::vec3 emission{0};           ///< cd/m² of a particle at birth; falls to 0 over its life
    int seed = 0;
};

/// A particle at an instant.
struct Particle {
    glm::vec3 position;  ///< world, m
    float radius;        ///< m
    glm::vec3 color;
    float opacity;
    glm::vec3 emission;
    float random;  ///< 0 to 1, the same for all its life
};

/// Appends the `count` particles that live at `time` [s]. They are a function of time and seed alone: particle i is
/// born every `lifetime` seconds, a share i / count of it after the first; with n its birth's number and a its age,
///     x(a) = x0(i, n) + (velocity + spread(i, n)) a + acceleration a² / 2,
/// opacity 4 s (1 - s) for s = a / lifetime, so that none appears or goes at once. `world` is the emitter's node's.
void append_particles(const ParticleEmitter& emitter, const glm::mat4& world, double time,
                      std::vector<Particle>& particles);

}  // namespace tyndall
