#pragma once

#include <string>
#include <vector>

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

class Frame;
struct Estimate;

/// Where ambient light differs from place to place (Inputs::has_sky_radiance) techniques are lit without it, and it
/// is added here: to what they give, smooth and without noise, whatever the technique.
void add_sky_light(Frame& frame, Estimate& estimate);
/// To pixels that were drawn again at the host's size: those at which `mask`, a depth buffer, is not 0.
void add_sky_light_again(Frame& frame, Estimate& estimate, TextureRef mask);
/// To froxels, for their last step and for transparents. `radiance` is of froxels lit without it.
void add_froxel_sky(Frame& frame, TextureRef columns, TextureRef& radiance);
[[nodiscard]] const std::vector<std::string>& sky_light_passes();

}  // namespace tyndall::volumetrics
