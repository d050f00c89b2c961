#pragma once

#include "frame/passes.h"

namespace tyndall::volumetrics {

/// Light as what it is unshadowed, which has no noise, and the visible share of it: only the latter is filtered.
struct Relit {
    TextureRef light;  ///< RGBA16F: radiance; empty: none
    TextureRef share;  ///< RGBA16F: 0 … 1 by channel, a = 1; all 0 where there is no light
    explicit operator bool() const { return static_cast<bool>(light); }
};

/// What the march leaves to be reconstructed.
struct MarchedLight {
    Outputs rest;  ///< scattering without `sun` and `lamps`, transmittance
    Relit sun = {}, lamps = {};
};

/// Why the march leaves all light in one, for the setting reconstruct; null where it does not.
[[nodiscard]] const char* reason_for_light(const Inputs& inputs, const Settings& settings, const FrameMedia& media);
/// The reasons that lie in the settings alone.
[[nodiscard]] const char* reason_for_light(const Settings& settings);

/// What of the march has to be filtered: two textures at most.
[[nodiscard]] Outputs noisy_part(const MarchedLight& marched);
/// Light again, of noisy_part() filtered, at its resolution.
[[nodiscard]] Outputs add_relight(PassList& passes, const PassResources& resources, const MarchedLight& marched,
                                  const Outputs& filtered, bool count_work);

}  // namespace tyndall::volumetrics
