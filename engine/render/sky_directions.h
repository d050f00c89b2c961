#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall {

/// Light of a part of the sky, of red, green and blue: x its share of the mean radiance over the sphere, yzw three
/// times its share of the mean of radiance times direction (shaders/lib/sky_radiance.glsl).
using SkyLight = std::array<glm::vec4, 3>;

struct SkyPart {
    glm::vec3 direction{0, 1, 0};  ///< unit, to the middle of its light
    SkyLight light{};
};

/// The whole sky in `count` parts. `cube`: its radiance, RGBA, six faces of size x size texels, `size` a power of
/// two. Three quarters of what makes a part as great as another are its light, one quarter is its size above the
/// horizon: where the sky is bright parts are small. Some may be empty. Any first ones are spread over the sky.
[[nodiscard]] std::vector<SkyPart> share_sky(std::span<const glm::vec4> cube, int size, int count);
[[nodiscard]] SkyLight sum_of_light(std::span<const SkyPart> parts);

}  // namespace tyndall
