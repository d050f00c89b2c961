#include "engine/scene/particles.h"

#include <cmath>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/noise.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

/// Independent uniform numbers of one birth.
class Random {
  public:
    Random(int seed, int index, std::int64_t birth)
        : key_(static_cast<unsigned>(index), static_cast<unsigned>(birth), 0), seed_(static_cast<unsigned>(seed)) {}
    float next() {
        ++key_.z;
        return glsl::unit_float(glsl::hash_uvec3(key_, seed_));
    }
    /// Evenly in the unit ball.
    glm::vec3 in_ball() {
        const float z = 2 * next() - 1, angle = 6.2831853f * next(), radius = std::cbrt(next());
        const float flat = std::sqrt(std::max(1 - z * z, 0.0f));
        return radius * glm::vec3(flat * std::cos(angle), flat * std::sin(angle), z);
    }

  private:
    glm::uvec3 key_;
    unsigned seed_;
};

}  // namespace

void append_particles(const ParticleEmitter& emitter, const glm::mat4& world, double time,
                      std::vector<Particle>& particles) {
    for (int i = 0; i < emitter.count; ++i) {
        const double lives = time / emitter.lifetime - static_cast<double>(i) / emitter.count;
        const double birth = std::floor(lives);
        const auto share = static_cast<float>(lives - birth);
        const float age = share * emitter.lifetime;
        // 2^31 births are half a year of a lifetime of 8 ms; then they come again.
        Random random(emitter.seed, i, static_cast<std::int64_t>(std::fmod(birth, 2147483648.0)));
        const glm::vec3 start = emitter.extent * random.in_ball();
        const glm::vec3 velocity = emitter.velocity + emitter.spread * random.in_ball();
        const glm::vec3 at = start + velocity * age + emitter.acceleration * (0.5f * age * age);
        particles.push_back({.position = glm::vec3(world * glm::vec4(at, 1)),
                             .radius = emitter.size + emitter.growth * age,
                             .color = emitter.color,
                             .opacity = emitter.opacity * 4 * share * (1 - share),
                             .emission = emitter.emission * (1 - share),
                             .random = random.next()});
    }
}

}  // namespace tyndall
