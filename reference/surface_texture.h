#pragma once

#include <glm/glm.hpp>

#include "engine/scene/scene.h"

namespace tyndall::reference {

using glm::dvec2;
using glm::dvec4;

/// The texel of a row or column of `size` that a place beyond its ends, too, shows.
[[nodiscard]] std::size_t texel_of(double place, int size, Wrap wrap);

/// Look-up in the full-resolution picture, bilinear or nearest as its sampling says, texel centres at
/// (i + 0.5) / size. `srgb`: the colour is decoded before it is filtered; alpha never is. 0..1.
[[nodiscard]] dvec4 sample(const Picture& picture, dvec2 uv, bool srgb);

/// Linear base colour with alpha: factor times texture times the vertices' colour.
[[nodiscard]] dvec4 base_color(const Scene& scene, const Material& material, dvec2 uv, dvec4 vertex_color);

/// The alpha that a mask's cutoff is compared with: factor times the base colour texture's.
[[nodiscard]] double mask_alpha(const Scene& scene, const Material& material, dvec2 uv);

}  // namespace tyndall::reference
