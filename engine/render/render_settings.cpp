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
                      "The sky's light knows walls and directions: a volume of it over the scene; off, all places "
                      "have the same."},
                     permutation)
            .integer(&S::sky_directions,
                     {"sky_directions", "Sky directions",
                      "Parts of the sky that light the volume: a depth map of the scene for each of them, "
                      "whenever it is built."},
                     16, 2048, resource, logarithmic)
            .integer_of(&S::sky_cells,
                        {"sky_cells", "Sky cells",
                         "Cells across each level of the sky volume, and three quarters as many in height: 24 MiB "
                         "at 64."},
                        {16, 24, 32, 48, 64, 72}, resource)
            .real(&S::sky_cell,
                  {"sky_cell", "Sky cell",
                   "Width of a cell of the finest level, round the eye; each coarser one is three times as wide.",
                   "m"},
                  0.05, 4, logarithmic)
            .boolean(&S::shadows,
                     {"shadows", "Shadows", "Shadow maps of the sun and the lamps; off frees them and lights all."},
                     permutation)
            .integer_of(&S::cascade_size,
                        {"cascade_size", "Cascade size",
                         "Pixels of each of the sun's 4 shadow cascades along a side; its map is a sixteenth "
                         "wider, for the camera to move in. Finer shadows for memory and fill.",
                         "px"},
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
