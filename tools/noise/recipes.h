#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/noise/generate.h"

namespace tyndall::noise {

/// A committed texture: assets/noise/NAME_128x128x32_r8.raw.
struct Recipe {
    std::string name;
    std::vector<Energy> energies;
    std::uint64_t seed;
    [[nodiscard]] std::string file_name() const { return name + "_128x128x32_r8.raw"; }
};

constexpr int recipe_sweeps = 64;  ///< for each energy

/// blue: slices of blue noise, independent of each other. stbn: blue in space and in time at once. fast_TIME_SPACE
/// for each pair of filters of filters.h.
[[nodiscard]] const std::vector<Recipe>& recipes();

}  // namespace tyndall::noise
