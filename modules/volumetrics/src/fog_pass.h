#pragma once

#include "passes.h"

namespace tyndall::volumetrics {

/// A full-screen pass that computes a technique's outputs from nothing but depth, sun, ambient light and the global
/// media. `shader` has the depth at unit 0, and the dither tile.
[[nodiscard]] Outputs add_fog_pass(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                   const FrameMedia& media, const char* name, const gl::Program& shader);

/// The axes HEIGHT_MEDIA, CHROMATIC, RAYLEIGH and COUNT_WORK.
[[nodiscard]] Permutation fog_permutation(const Inputs& inputs, const FrameMedia& media);

}  // namespace tyndall::volumetrics
