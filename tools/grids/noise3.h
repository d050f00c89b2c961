// Noise in space that is the same on every machine: integer hashes, and only arithmetic that IEEE 754 rounds
// exactly.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace tyndall::grid_models {

/// Perlin 2002, "Improving Noise": gradients at whole coordinates, about -1 to 1.
[[nodiscard]] float gradient_noise(glm::vec3 p, std::uint32_t seed);
/// Sum of `octaves` of them, each twice as fine and half as strong.
[[nodiscard]] float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed);
/// Worley 1996, "A Cellular Texture Basis Function": 1 at the points scattered one a cell, 0 at distance 1.
[[nodiscard]] float billows(glm::vec3 p, std::uint32_t seed);

}  // namespace tyndall::grid_models
