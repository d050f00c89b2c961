#pragma once

#include <vector>

#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

/// Of the lamps in view at most `most`, those that send the picture most of the light that the medium scatters:
/// what reaches all of a picture's rays from a lamp of intensity I at the distance D is in proportion to
///     I / max(D, 1 m) * exp(-sigma_t D) * min(1, range / D),
/// for the integral of 1 / (distance of the ray from the lamp) over a disc of rays round it grows as its radius.
/// Lamps below `least` of the sum are left out, and those whose light has nothing sharp: they cast no shadow and
/// are no spots of 45 degrees or less from axis to rim, whose beams may be narrower than a froxel. sigma_t: 1/m, of
/// what fills space. In the order of `lamps`.
[[nodiscard]] std::vector<Lamp> choose_few_lamps(const std::vector<Lamp>& lamps, glm::vec3 eye, float sigma_t,
                                                 int most, float least);

}  // namespace tyndall::volumetrics
