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
    // Samples along each line, at fixed angles to the axis; 0: pixels ask the trees themselves.
    int samples = 0;
    float first_sample = 0;  ///< of the angle 0, a whole number
    float samples_per_radian = 0;
};

struct EpipolarPlan {
    std::vector<EpipolarLines> lights;
    std::int64_t nodes = 0;  ///< of all lines, two a cell

    void add(EpipolarLines lines, std::uint32_t index);  ///< nothing without cells
    /// Four RGBA texels a light, from index 0 to the largest one of `lights`; zero: no lines.
    [[nodiscard]] std::vector<glm::vec4> table() const;
};

/// The lines that the lights in view take. Angles round a light's axis have fixed places in the world, so that
/// lines stay where they are as the camera turns. `pixels`: that the picture is computed at. Where lamps
/// would take more rays than Settings say, all of them have their spacings doubled and their cells halved until
/// they do not (a picture counts as 128 x 128 pixels at least); the sun's spacing is doubled where it would take
/// half of most_epipolar_nodes. Where Settings want samples, the sun's lines have them as far apart as they
/// themselves are, or as most_epipolar_samples allows.
[[nodiscard]] EpipolarPlan plan_epipolar(const Inputs& inputs, const std::vector<Lamp>& lamps,
                                         const Settings& settings, glm::ivec2 pixels);

inline constexpr int most_epipolar_nodes = 1 << 24;  ///< 128 MiB
inline constexpr int most_epipolar_samples = 2048;   ///< a line: epipolar_choose.comp

/// Whether the sun's share is interpolated along its lines.
[[nodiscard]] inline bool samples_lines(const Settings& settings) {
    return settings.epipolar.step > 1;
}

/// Of a direction (xyz) in the world the pixel of a picture of `pixels`: xy / z, with z > 0 before the eye.
[[nodiscard]] glm::mat4 direction_to_pixel(const Inputs& inputs, glm::vec2 pixels);

}  // namespace tyndall::volumetrics
