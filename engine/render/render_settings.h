#pragma once

#include "engine/core/settings.h"

namespace tyndall {

/// Quality and look of the renderer itself. Ranges, units, help: `render_settings_table()`.
struct RenderSettings {
    float exposure_bias = 0;  ///< stops, added to the scene's exposure
    float ambient = 0.4f;  ///< factor on the sky's light: without sky_visibility nothing blocks it, and 1 is light
                           ///< of an open plain
    /// The sky's light meets walls: see SkyVolumePass.
    bool sky_visibility = false;
    int sky_directions = 192, sky_cells = 48;
    float sky_cell = 0.5f;  ///< m
    bool shadows = true;
    int cascade_size = 1024;        ///< px per side of each of the 4 cascades: see cascade_map_size
    float cascade_distance = 80;    ///< m of view depth the cascades cover
    float cascade_split = 0.75f;    ///< 0 uniform … 1 logarithmic
    int static_shadow_size = 2048;  ///< px, the baked map behind the cascades
    int atlas_size = 4096;          ///< px, local lights' shadows
    int tile_size_max = 512;        ///< px, largest tile of the atlas
    bool occlusion_culling = true;  ///< depth-pyramid test before light clustering
    int cluster_x = 16, cluster_y = 9, cluster_z = 24;
    float cluster_far = 256;  ///< m
};

[[nodiscard]] const SettingsTable& render_settings_table();

}  // namespace tyndall
