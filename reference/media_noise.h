#pragma once

#include <glm/glm.hpp>
#include <span>

namespace tyndall::reference {

/// The factor of noise of a medium in [0, 2], as shaders/lib/media_density.glsl has it (media_noise): it is part of
/// a scene's description. Many points at once, in single precision and the same order of operations.
struct MediaNoise {
    float scale = 0, amount = 0;  ///< m, 0..1
    unsigned seed = 0;

    void factors(std::span<const glm::vec3> points, std::span<float> factors) const;
    [[nodiscard]] float factor(glm::vec3 point) const;
};

}  // namespace tyndall::reference
