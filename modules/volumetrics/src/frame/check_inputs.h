#pragma once

#include "volumetrics/inputs.h"

namespace tyndall::volumetrics {

/// What can be told of them alone. Throws Error that names the member, what it is and what was expected.
void check_inputs(const Inputs& inputs);

/// That its textures are in `passes`, in their newest version, and of the size and a format that are read.
/// Likewise.
void check_textures(const PassList& passes, const Inputs& inputs);
/// Of the picture that is composited over.
void check_color(const PassList& passes, TextureRef color, glm::ivec2 size);

}  // namespace tyndall::volumetrics
