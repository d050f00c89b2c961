// Entries of a scene's extras.media.
#pragma once

#include <nlohmann/json.hpp>

#include "tools/modeling/mesh.h"

namespace tyndall::modeling {

// Of a grey medium, in 1/m; anisotropy g in (-1, 1).
struct Coefficients {
    float scattering, absorption = 0.0f, anisotropy = 0.0f;
};

nlohmann::json global_medium(const Coefficients& c);
// Density exp(-(y - base) / falloff), metres.
nlohmann::json height_medium(const Coefficients& c, float base, float falloff);
// `size` is the whole edge lengths, `softness` the width of the ramp at the rim, metres.
nlohmann::json box_medium(const Coefficients& c, vec3 center, vec3 size, float softness);
nlohmann::json ellipsoid_medium(const Coefficients& c, vec3 center, vec3 radii, float softness);
// The member "noise" of a bounded medium: metres per period, amount in [0, 1].
nlohmann::json medium_noise(float scale, float amount, int seed);

}  // namespace tyndall::modeling
