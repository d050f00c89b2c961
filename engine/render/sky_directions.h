#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall {

/// Unit vectors that cover the sphere evenly, four fifths of them the half above the horizon, from where most light
/// comes. Any first ones of them cover it evenly, too.
[[nodiscard]] std::vector<glm::vec3> sky_directions(int count);

/// Light of a part of the sky, of red, green and blue: x its share of the mean radiance over the sphere, yzw three
/// times its share of the mean of radiance times direction (shaders/lib/sky_radiance.glsl).
using SkyLight = std::array<glm::vec4, 3>;
/// `cube`: radiance of the sky, RGBA, six faces of size x size texels. Each texel is given to the direction nearest
/// to it, so that all parts together are the whole sky.
[[nodiscard]] std::vector<SkyLight> share_sky(std::span<const glm::vec4> cube, int size,
                                              std::span<const glm::vec3> directions);
[[nodiscard]] SkyLight sum(std::span<const SkyLight> parts);

}  // namespace tyndall
