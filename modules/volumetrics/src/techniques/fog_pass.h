#pragma once

#include "frame/passes.h"

namespace tyndall::volumetrics {

/// A full-screen pass that reads nothing but depth (unit 0), the noise tile, sun, ambient light, the global media
/// and `visibility` (unit 1), if there is one. `targets` are what it draws to.
struct FogPass {
    const char* name;
    const gl::Program& shader;
    TextureRef visibility = {};
    Outputs targets = {};
};
[[nodiscard]] Outputs add_fog_pass(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                   const FogPass& pass);

/// New targets for scattering and, where extinction is coloured, transmittance.
[[nodiscard]] Outputs fog_targets(PassList& passes, const Inputs& inputs, const FrameMedia& media);

/// The axes HEIGHT_MEDIA, CHROMATIC and COUNT_WORK.
[[nodiscard]] Permutation fog_permutation(const Inputs& inputs, const FrameMedia& media);

}  // namespace tyndall::volumetrics
