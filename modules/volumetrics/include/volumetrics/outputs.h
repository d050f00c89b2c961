#pragma once

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

/// Light and transmittance along all view rays, for what a host draws forward over the fogged picture with
/// shaders/volumetrics/frame/apply.glsl: a pass that includes it samples them (Volumetrics::sample_fog, bind_fog).
/// Empty without a medium, and where neither the technique nor Inputs::transparents asked for it. Of technique
/// froxel it goes up to the farthest thing seen, of the others up to the farthest of Inputs::transparents.
struct Fog {
    TextureRef columns = {};        ///< R32F: view depth [m] at which each column of froxels ends; 0: it is empty
    TextureRef radiance = {};       ///< RGBA16F volume
    TextureRef optical_depth = {};  ///< RGBA16F volume; empty where one value holds for all channels
    explicit operator bool() const { return static_cast<bool>(radiance); }
};

/// Pre-multiplied result: color = scattering + color * transmittance. Empty refs: nothing to apply.
struct Outputs {
    TextureRef scattering = {};     ///< RGBA16F (of the technique reference RGBA32F, as all it gives): in-scattered
                                    ///< and emitted radiance; a = mean transmittance
    TextureRef transmittance = {};  ///< RGBA16F, only when some medium's extinction is coloured; else scattering.a
                                    ///< holds for all channels
    TextureRef acceptance = {};     ///< R16F, where Inputs::acceptance asks for it and there is a mean over frames:
                                    ///< share 0 … 1 of what was kept that each pixel took
    TextureRef samples = {};  ///< RGBA8, where Inputs::samples asks for it, of technique epipolar with samples: how
                              ///< each pixel's sunlight was found (shaders/volumetrics/light/epipolar_view.frag)
    Fog fog = {};
};

/// What media do to light on its way to surfaces: for a host's own lighting shaders, which include
/// shaders/volumetrics/light/light_transmittance.glsl where `any` says so.
struct LightTransmittance {
    bool any = false;
    /// Value of the define LIGHT_VOLUMES: local media dim some light (1), density grids among them (2).
    int light_volumes = 0;
    TextureRef sun_volume, grid_sun_volume, lamp_volumes;  ///< sampled there, bound by Volumetrics::bind_uniforms
};

}  // namespace tyndall::volumetrics
