#pragma once

#include <string>
#include <vector>

#include "engine/core/image.h"
#include "frame.h"

namespace tyndall::stress {

/// The layers of one drawn frame; light in units of Scene::light_unit().
struct Layers {
    Image scattering, transmittance, color, depth;
};
[[nodiscard]] Layers read_layers(const Renderer& renderer, const Scene& scene);

/// What is wrong, where, and the value; one line.
using Findings = std::vector<std::string>;

constexpr float half_max = 65504;
/// Most light that the layers hold: the technique reference keeps its own in single precision.
[[nodiscard]] float most_light(const StressFrame& frame);

/// All finite, none negative, transmittance at most 1, color at most 65504, scattering at most `most`; at most one
/// finding a layer.
void check_values(const Layers& layers, float most, Findings& findings);

/// GL errors and debug messages of medium or high severity since the last call.
void check_gl(Findings& findings);

/// Along a ray transmittance falls: behind a surface (`with`) no more light may come through than in front of it.
/// `without` is the same view of the same media without any surface. Returns the number of pixels that were
/// compared. Holds to the rounding of half floats and of sums of `steps` segments.
int check_monotonic(const Layers& with, const Layers& without, int steps, Findings& findings);

}  // namespace tyndall::stress
