#pragma once

#include "engine/render/lamps.h"

namespace tyndall {

/// What this frame contains: passes and shader permutations are functions of these and of settings, of nothing
/// else.
struct FrameFacts {
    bool has_sun = false;      ///< a sun with non-zero illuminance
    bool has_ambient = false;  ///< the sky: always, for nights have one; whoever turns ambient light off clears it
    bool sky_visibility = false;     ///< with it, sky light that knows what stands in its way
    bool sun_through_glass = false;  ///< find_glass(): some may stand between the sun and what is in view
    bool has_global_medium = false;
    bool has_local_media = false;  ///< bounded media whose bounds are in view
    std::vector<Lamp> lamps;       ///< all that shine, further suns first
    int local_lights_in_view = 0;  ///< of them
    [[nodiscard]] bool has_medium() const { return has_global_medium || has_local_media; }
    [[nodiscard]] int glass() const;  ///< GLASS_SUN, GLASS_LAMPS: before what light in view
};

/// Lights that do not shine and media that neither scatter, absorb nor shine do not count.
[[nodiscard]] FrameFacts compute_facts(const Scene& scene, const View& view);

}  // namespace tyndall
