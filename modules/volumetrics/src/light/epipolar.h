#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// Lines of one light through the picture, as shaders/volumetrics/light/epipolar.glsl has them.
struct EpipolarLines {
    std::uint32_t index = 0;  ///< 0 the sun, 1 + Lamp::index a lamp
    glm::vec3 axis{0};        ///< unit, from the eye to the light
    float distance = 0;       ///< m, of a lamp; 0: its light is parallel
    glm::vec3 first{0};       ///< unit, across the axis: where the first line begins
    float lines_per_radian = 0;
    float cells_per_unit = 0;
    int lines = 0;
    int cells = 0;  ///< a line, a power of two
    int nodes = 0;  ///< index of the first line's
};

struct EpipolarPlan {
    std::vector<EpipolarLines> lights;
    int nodes = 0;  ///< of all lines, two a cell

    /// Three RGBA texels a light, from index 0 to the largest one of `lights`; zero: no lines.
    [[nodiscard]] std::vector<glm::vec4> table() const;
};

/// The lines that the lights in view take. Angles round a light's axis have fixed places in the world, so that
/// lines stay where they are as the camera turns. `pixels`: that the picture is computed at. What a spacing and a
/// number of cells would take beyond most_epipolar_nodes is taken by halving cells and doubling spacings of lamps.
[[nodiscard]] EpipolarPlan plan_epipolar(const Inputs& inputs, const Settings& settings, glm::ivec2 pixels);

inline constexpr int most_epipolar_nodes = 1 << 24;  ///< 128 MiB

}  // namespace tyndall::volumetrics
