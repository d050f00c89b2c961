#pragma once

#include "engine/graph/pass_list.h"

namespace tyndall::volumetrics {

/// Pre-multiplied result: color = scattering + color * transmittance. Empty refs: nothing to apply.
struct Outputs {
    TextureRef scattering;     ///< RGBA16F: in-scattered and emitted radiance; a = mean transmittance
    TextureRef transmittance;  ///< RGBA16F, only when some medium's extinction is coloured; else scattering.a holds
                               ///< for all channels
};

}  // namespace tyndall::volumetrics
