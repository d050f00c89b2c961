#pragma once

#include <glm/glm.hpp>

#include "engine/scene/scene.h"
#include "engine/scene/view.h"

namespace tyndall {

/// What this frame contains: passes and shader permutations are functions of these and of settings, of nothing
/// else.
struct FrameFacts {
    bool has_sun = false;      ///< a sun with non-zero illuminance
    bool has_ambient = false;  ///< the sky: always; whoever turns ambient light off clears it
    bool has_global_medium = false;
    bool has_local_media = false;      ///< bounded media whose bounds are in view
    int local_lights_in_view = 0;      ///< lamps whose sphere of influence meets the view frustum
    bool has_shadowed_lights = false;  ///< a lamp in view casts shadows
    bool has_emissive_media = false;
    bool camera_inside_medium = false;
    float max_extinction = 0;  ///< 1/m, largest channel of the densest medium in view, at density 1
    [[nodiscard]] bool has_medium() const { return has_global_medium || has_local_media; }
};

/// Lights and media that neither scatter, absorb nor shine do not count.
[[nodiscard]] FrameFacts compute_facts(const Scene& scene, const View& view);

}  // namespace tyndall
