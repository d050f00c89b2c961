#include "engine/render/render_settings.h"

namespace tyndall {

const SettingsTable& render_settings_table() {
    using S = RenderSettings;
    constexpr auto resource = SettingEffect::resource, permutation = SettingEffect::permutation;
    constexpr auto logarithmic = SettingScale::logarithmic;
    static const SettingsTable table =
        SettingsTable("Renderer")
            .real(&S::exposure_bias,
                  {"exposure_bias", "Exposure bias",
                   "Brightens or darkens the picture around the scene's exposure.", "stops"},
                  -10, 10)
            .real(&S::ambient,
                  {"ambient", "Ambient",
                   "Factor on the sky's light on surfaces and in media; 0 leaves the pass out."},
                  0, 4)
            .boolean(&S::sky_visibility,
                     {"sky_visibility", "Sky visibility",
                      "The sky lights what sees it, from where it is bright; off: all alike, through walls."},
                     permutation)
            .boolean(&S::shadows,
                     {"shadows", "Shadows", "Shadow maps of the sun and the lamps; off frees them and lights all."},
                     permutation)
            .integer_of(&S::cascade_size,
                        {"cascade_size", "Cascade size",
                         "Side of each of the sun's 4 shadow cascades; finer shadows for memory and fill.", "px"},
                        {256, 512, 1024, 2048, 4096}, resource)
            .real(&S::cascade_distance,
                  {"cascade_distance", "Cascade distance",
                   "View depth that the cascades share; the baked map serves what is farther.", "m"},
                  10, 1000, logarithmic)
            .real(&S::cascade_split,
                  {"cascade_split", "Cascade split", "How the cascades share it: 0 equal parts, 1 equal ratios."},
                  0, 1)
            .integer_of(&S::static_shadow_size,
                        {"static_shadow_size", "Baked shadow size",
                         "Side of the sun's map of the whole scene behind the cascades.", "px"},
                        {256, 512, 1024, 2048, 4096, 8192}, resource)
            .integer_of(
                &S::atlas_size,
                {"atlas_size", "Shadow atlas size", "Side of the atlas that the lamps' shadow maps share.", "px"},
                {512, 1024, 2048, 4096, 8192}, resource)
            .integer_of(&S::tile_size_max,
                        {"tile_size_max", "Largest shadow tile",
                         "Side of the largest shadow map a lamp may get in the atlas.", "px"},
                        {64, 128, 256, 512, 1024, 2048, 4096}, resource)
            .boolean(
                &S::occlusion_culling,
                {"occlusion_culling", "Occlusion culling",
                 "Leaves out lamps that are hidden behind what the depth buffer holds; costs a depth pyramid."},
                permutation)
            .integer(&S::cluster_x,
                     {"cluster_x", "Clusters across", "Light clusters over the width of the screen."}, 1, 64,
                     resource, logarithmic)
            .integer(&S::cluster_y, {"cluster_y", "Clusters up", "Light clusters over the height of the screen."},
                     1, 64, resource, logarithmic)
            .integer(&S::cluster_z,
                     {"cluster_z", "Cluster slices", "Light clusters in view depth, in equal ratios."}, 1, 128,
                     resource, logarithmic)
            .real(&S::cluster_far,
                  {"cluster_far", "Cluster distance",
                   "View depth where the last slice begins to hold all the rest.", "m"},
                  8, 4000, logarithmic);
    return table;
}

}  // namespace tyndall
