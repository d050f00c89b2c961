#include "frame/settings_table.h"
#include "volumetrics/technique.h"

namespace tyndall::volumetrics {

namespace {

SettingsTable::Text curve_text(int part) {
    const std::string number = std::to_string(part);
    return {
        "froxel_curve_" + number, "Froxel curve " + number,
        "Distribution curve: relative thickness of the slices in eighth " + number + " of them, from the eye on."};
}

}  // namespace

SettingsTable& growing_settings_table() {
    using Effect = SettingEffect;
    using Scale = SettingScale;
    using S = Settings;
    static SettingsTable table =
        SettingsTable("Volumetrics")
            .name(&S::technique,
                  {"technique", "Technique", "How light in the medium is computed; off costs nothing."},
                  technique_names, Effect::permutation)
            .integer(in(&S::march, &MarchSettings::steps),
                     {"steps", "Steps",
                      "Segments per ray; time grows in proportion, error falls where shadow edges are."},
                     1, 1024, Effect::uniform, Scale::logarithmic)
            .choice(in(&S::march, &MarchSettings::stepping),
                    {"stepping", "Stepping",
                     "Equal segments, or segments that grow with distance and so are finer near the eye."},
                    {"uniform", "exponential"}, Effect::uniform)
            .real(in(&S::march, &MarchSettings::stepping_strength),
                  {"stepping_strength", "Stepping strength",
                   "Natural logarithm of the ratio of the last to the first segment of exponential stepping."},
                  0.01, 10)
            .real(in(&S::march, &MarchSettings::max_distance),
                  {"max_distance", "Maximum distance",
                   "Length of the marched ray; behind it global media go on in closed form, without shadows or "
                   "lamps.",
                   "m"},
                  1, 100000, Scale::logarithmic)
            .real(in(&S::march, &MarchSettings::grid_piece),
                  {"grid_piece", "Grid piece",
                   "Length of the pieces in which a ray tells density and light of a density grid apart, in "
                   "voxels, or in "
                   "pixels' widths where those are more; they grow as what is left of the light falls."},
                  0.25, 4, Scale::logarithmic)
            .choice(in(&S::light, &LightSettings::lamp_integration),
                    {"lamp_integration", "Lamp integration",
                     "Light of lamps at one point of each segment; or over the segment, with the closed form of "
                     "the inverse square, which costs more per lamp and needs far fewer steps."},
                    {"center", "segment"}, Effect::permutation)
            .boolean(
                in(&S::light, &LightSettings::transmittance),
                {"light_transmittance", "Light transmittance",
                 "Light is attenuated by media on its way to the point or surface it reaches, by local ones as the "
                 "sun and lamp volumes hold them; a homogeneous global medium does not attenuate the sun."},
                Effect::permutation)
            .choice(in(&S::light, &LightSettings::phase),
                    {"phase", "Phase function",
                     "Of all media but air: Henyey-Greenstein; Schlick's approximation of it, which is slightly "
                     "cheaper; Cornette-Shanks, which becomes Rayleigh's as the anisotropy goes to 0; a second, "
                     "backward lobe of Henyey-Greenstein; or that of water droplets, Henyey-Greenstein and Draine, "
                     "whatever the media's anisotropies."},
                    {"henyey_greenstein", "schlick", "cornette_shanks", "double_henyey_greenstein", "hg_draine"},
                    Effect::uniform)
            .real(in(&S::light, &LightSettings::back_anisotropy),
                  {"phase_back_anisotropy", "Back lobe anisotropy",
                   "Mean cosine of the backward lobe of the phase function double_henyey_greenstein."},
                  -0.999, 0)
            .real(in(&S::light, &LightSettings::back_weight),
                  {"phase_back_weight", "Back lobe weight",
                   "Share of the light that double_henyey_greenstein scatters in its backward lobe."},
                  0, 1)
            .real(in(&S::light, &LightSettings::droplet_diameter),
                  {"phase_droplet_diameter", "Droplet diameter",
                   "Of the phase function hg_draine: about 10 in clouds, 5 to 20 in fog; larger ones scatter "
                   "farther forward.",
                   "um"},
                  5, 50)
            .integer(in(&S::light, &LightSettings::sky_steps),
                     {"sky_steps", "Sky steps",
                      "Along a view ray, at which media ask for the sky's light where walls keep some of it out "
                      "(sky_visibility)."},
                     1, 128, Effect::uniform)
            .integer(in(&S::light, &LightSettings::scattering_orders),
                     {"scattering_orders", "Scattering orders",
                      "Of sunlight in density grids: 1 is scattered once, which is what the references have; more "
                      "make thick clouds bright, each as if half as much matter scattered half as far."},
                     1, 8, Effect::uniform)
            .choice(in(&S::noise, &NoiseSettings::kind),
                    {"noise", "Noise",
                     "Where in its segments a pixel samples: the middle; the Bayer matrix; white noise, of each "
                     "pixel or of a shuffled tile; interleaved gradient noise; or textures of noise: blue, blue in "
                     "time too (stbn), or made for the filter that follows (fast)."},
                    {"none", "bayer", "white", "white_tile", "ign", "blue", "stbn", "fast"}, Effect::resource)
            .integer_of(in(&S::noise, &NoiseSettings::size),
                        {"noise_size", "Noise size",
                         "Side of the tile of bayer and white_tile; a larger one has more offsets and needs a "
                         "wider filter.",
                         "px"},
                        {2, 4, 8, 16}, Effect::resource)
            .choice(in(&S::noise, &NoiseSettings::time),
                    {"noise_time", "Noise in time",
                     "How the noise changes from frame to frame, for what averages frames: not at all; in its own "
                     "way (the next slice of a texture, other white noise, a shifted gradient; a tile by the "
                     "golden ratio); all offsets by the golden ratio; or all pixels by the R2 sequence times the "
                     "side of the tile, or times 128 px."},
                    {"fixed", "own", "golden_ratio", "r2"}, Effect::uniform)
            .choice(in(&S::noise, &NoiseSettings::fast_space),
                    {"fast_space", "FAST in space", "Spatial filter that the noise fast was made for."},
                    spatial_kernel_names(), Effect::resource)
            .choice(in(&S::noise, &NoiseSettings::fast_time),
                    {"fast_time", "FAST in time",
                     "Temporal filter that the noise fast was made for: an exponential mean of weight 0.1, or the "
                     "mean of 8 frames."},
                    temporal_kernel_names(), Effect::resource)
            .choice(in(&S::filter, &FilterSettings::kernel),
                    {"filter", "Filter",
                     "Spatial filter that takes noise away, in two passes: mean of 3 or 5 pixels each way, "
                     "Gaussian of sigma 1 in 7 taps, binomial of 3 or 5 taps, Gaussian of chosen sigma in 15 taps, "
                     "or mean of 9 (uniform9). What lies outside of the picture is left out."},
                    {"none", "box3", "box5", "gaussian1", "binomial3", "binomial5", "gaussian15", "uniform9"},
                    Effect::permutation)
            .real(in(&S::filter, &FilterSettings::sigma),
                  {"filter_sigma", "Filter sigma",
                   "Standard deviation of the filter gaussian15; beyond 3.5 the 15 taps cut it off.", "px"},
                  0.3, 7)
            .boolean(in(&S::filter, &FilterSettings::narrows),
                     {"filter_narrows", "Filter narrows",
                      "The filter is the narrower the more frames are in a pixel's mean, for less noise is left. "
                      "Where temporal is accumulate, before the filter."},
                     Effect::permutation)
            .choice(in(&S::filter, &FilterSettings::depth),
                    {"filter_depth", "Filter and depth",
                     "Whether the filter stops at depth edges: not at all; where depth differs from the pixel's; "
                     "or where it also differs from the plane that the pixel lies in, so that grazing floors are "
                     "filtered."},
                    {"none", "relative", "plane"}, Effect::permutation)
            .real(in(&S::filter, &FilterSettings::depth_falloff),
                  {"filter_depth_falloff", "Filter depth falloff",
                   "How fast the weight falls with relative depth difference: it is 0 from a difference of 1 / "
                   "falloff on. Of the filter and of bilateral up-sampling."},
                  0, 100)
            .choice(in(&S::filter, &FilterSettings::reconstruct),
                    {"reconstruct", "Reconstruct",
                     "What the filter, and a mean over frames before it, take from ray_march and from the lamps of "
                     "shaft_geometry: the light; or the visible share of it, times the unshadowed light of each "
                     "pixel, which has no noise."},
                    {"light", "visibility"}, Effect::permutation)
            .choice(in(&S::resolution, &ResolutionSettings::size),
                    {"resolution", "Resolution",
                     "Pixels along each side that all techniques but analytic_fog and reference are computed at, "
                     "of froxel the application alone; time falls with the square."},
                    {"full", "half", "quarter"}, Effect::resource)
            .choice(in(&S::resolution, &ResolutionSettings::depth),
                    {"resolution_depth", "Resolution depth",
                     "Which depth of a block stands for it at a lower resolution: the nearest, the farthest, or "
                     "both in turn like a checkerboard."},
                    {"min", "max", "checkerboard"}, Effect::uniform)
            .choice(in(&S::resolution, &ResolutionSettings::upsample),
                    {"upsample", "Up-sampling",
                     "From lower to full resolution: the nearest pixel; bilinear; bilinear without pixels of other "
                     "depths; or the pixel of the nearest depth, where depths differ."},
                    {"nearest", "bilinear", "bilateral", "nearest_depth"}, Effect::uniform)
            .real(in(&S::resolution, &ResolutionSettings::tolerance),
                  {"resolution_tolerance", "Tolerance for grids",
                   "Where density grids are in view of ray_march or epipolar at a lower resolution: pixels around "
                   "which light or transmittance bend by more than this part are drawn again at full resolution; "
                   "1: none are."},
                  0.01, 1, Scale::logarithmic)
            .choice(in(&S::temporal, &TemporalSettings::mode),
                    {"temporal", "Temporal filter",
                     "Mean over frames: none; of the same pixel, ugly in motion; an exponential mean along "
                     "reprojected motion; the same, less of it the farther the surface found there is from this "
                     "one; or a mean that counts its frames."},
                    {"off", "blend", "ema", "acceptance", "accumulate"}, Effect::resource)
            .choice(
                in(&S::temporal, &TemporalSettings::place),
                {"temporal_place", "Temporal place", "Before the spatial filter and up-sampling, or after them."},
                {"before", "after"}, Effect::resource)
            .real(in(&S::temporal, &TemporalSettings::weight),
                  {"temporal_weight", "Temporal weight", "Least weight of the new frame, but for accumulate."},
                  0.01, 1)
            .real(in(&S::temporal, &TemporalSettings::scale),
                  {"temporal_scale", "Temporal scale",
                   "Of acceptance and accumulate: what is kept falls by exp(-distance * scale), of this surface to "
                   "the one seen there before; the distance is relative to that of the nearer one from the camera. "
                   "0 keeps all.",
                   ""},
                  0, 1000)
            .integer(in(&S::temporal, &TemporalSettings::frames),
                     {"temporal_frames", "Temporal frames", "Most frames that accumulate counts."}, 1, 256,
                     Effect::uniform, Scale::logarithmic)
            .boolean(
                in(&S::temporal, &TemporalSettings::clip),
                {"temporal_clip", "Temporal clip",
                 "Clips what is kept to the range of values around the pixel in the new frame, and of the noise "
                 "that temporal_reject has learnt. Light that few samples find gets darker. Not of blend."},
                Effect::uniform)
            .boolean(in(&S::temporal, &TemporalSettings::reject),
                     {"temporal_reject", "Temporal rejection",
                      "Forgets what is kept where the new frame differs from it by more than noise: lights, "
                      "shadows or media changed. Changes of sun, camera, global media and lamps that the host "
                      "tells count always. Not of blend."},
                     Effect::uniform)
            .integer(
                in(&S::froxels, &FroxelSettings::x),
                {"froxels_x", "Froxels across",
                 "Columns of froxels over the width: noise of local media, and all light of the technique froxel; "
                 "memory and time grow in proportion."},
                8, 512, Effect::resource)
            .integer(in(&S::froxels, &FroxelSettings::y),
                     {"froxels_y", "Froxels up", "Columns of froxels over the height."}, 8, 512, Effect::resource)
            .integer(in(&S::froxels, &FroxelSettings::z),
                     {"froxels_z", "Froxel slices", "Slices of each column in view depth."}, 8, 256,
                     Effect::resource)
            .integer(
                in(&S::froxels, &FroxelSettings::pixels),
                {"froxel_pixels", "Pixels a column",
                 "Least width and height of a column of froxels in the picture: a small one has fewer columns, "
                 "in steps of 8 across and 4 up. 0: as many as are set.",
                 "px"},
                0, 64, Effect::resource)
            .real(in(&S::froxels, &FroxelSettings::far),
                  {"froxel_far", "Froxel far distance",
                   "View depth where the froxels end; behind it local media have no noise, and in the technique "
                   "froxel there are neither lamps nor shadows.",
                   "m"},
                  4, 4096, Scale::logarithmic)
            .choice(in(&S::froxels, &FroxelSettings::distribution),
                    {"froxel_distribution", "Froxel distribution",
                     "Slices of equal thickness; in proportion to their depth, from 1/256 of the far distance on; "
                     "or logarithmic, in between: equal near the eye, in proportion to depth far from it; a curve "
                     "of your own; or auto, where the media in view are and before they have dimmed."},
                    {"linear", "exponential", "logarithmic", "curve", "auto"}, Effect::uniform)
            .real(in(&S::froxels, &FroxelSettings::curve_1), curve_text(1), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_2), curve_text(2), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_3), curve_text(3), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_4), curve_text(4), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_5), curve_text(5), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_6), curve_text(6), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_7), curve_text(7), 0.001, 1000, Scale::logarithmic)
            .real(in(&S::froxels, &FroxelSettings::curve_8), curve_text(8), 0.001, 1000, Scale::logarithmic)
            .integer(
                in(&S::froxels, &FroxelSettings::history),
                {"froxel_history", "Froxel history",
                 "Technique froxel: frames over which the visibility of sun and lamps is averaged, sampled all "
                 "over the froxel; more is smoother, and moving shadows lag more. 0: none, which costs nothing."},
                0, 256, Effect::resource)
            .integer(in(&S::billboards, &BillboardSettings::layers),
                     {"billboard_layers", "Billboard layers",
                      "Technique billboards: sheets of the global media up to the maximum distance, each lit at "
                      "every pixel; time grows in proportion."},
                     1, 256, Effect::uniform, Scale::logarithmic)
            .integer(
                in(&S::billboards, &BillboardSettings::local_layers),
                {"billboard_local_layers", "Billboard local layers",
                 "Technique billboards: sheets of each local medium; time grows in proportion where it is seen."},
                1, 64, Effect::uniform, Scale::logarithmic)
            .real(in(&S::billboards, &BillboardSettings::fade),
                  {"billboard_fade", "Billboard fade",
                   "Technique billboards: density falls to 0 over this distance to the eye, so that no sheet is "
                   "seen edge on or pops; 0 is none.",
                   "m"},
                  0, 10)
            .integer(in(&S::particles, &ParticleSettings::count),
                     {"particle_count", "Particles",
                      "Technique particles: of the global media, round the eye, a tenth of them in view; noise "
                      "falls and detail grows with it, time grows in proportion."},
                     512, 1048576, Effect::resource, Scale::logarithmic)
            .integer(in(&S::particles, &ParticleSettings::local_count),
                     {"particle_local_count", "Local particles",
                      "Technique particles: of all local media in view together, by volume and extinction, at "
                      "least 32 each; time grows in proportion."},
                     32, 1048576, Effect::resource, Scale::logarithmic)
            .real(in(&S::particles, &ParticleSettings::distance),
                  {"particle_distance", "Particle distance",
                   "Technique particles: where those of the global media end, behind them is the closed form "
                   "without shadows or lamps; particles are as fine as it is short.",
                   "m"},
                  4, 4096, Scale::logarithmic)
            .real(in(&S::particles, &ParticleSettings::size),
                  {"particle_size", "Particle size",
                   "Technique particles: radius in units of their spacing; larger are softer and less noisy, and "
                   "cost the square of it."},
                  0.25, 4)
            .real(in(&S::particles, &ParticleSettings::drift),
                  {"particle_drift", "Particle drift",
                   "Technique particles: how fast they move; a function of time, so that a time has one picture.",
                   "m/s"},
                  0, 10)
            .choice(in(&S::analytic_fog, &AnalyticFogSettings::mode),
                    {"fog_mode", "Fog mode",
                     "Technique analytic_fog: transmittance that falls linearly with distance, as a Gaussian of "
                     "it, or exponentially, with the media as they are at the eye; or exponential with their "
                     "height profiles."},
                    {"linear", "squared", "exponential", "height"}, Effect::uniform)
            .choice(in(&S::radial_shafts, &RadialShaftSettings::occlusion),
                    {"radial_occlusion", "Radial occlusion",
                     "Technique radial_shafts: the share of samples towards the sun on screen that something "
                     "covers; or which parts of the view ray the surfaces seen there shadow."},
                    {"coverage", "intervals"}, Effect::permutation)
            .integer(in(&S::radial_shafts, &RadialShaftSettings::samples),
                     {"radial_samples", "Radial samples",
                      "Technique radial_shafts: depths read between a pixel and the sun on screen."},
                     1, 512, Effect::uniform, Scale::logarithmic)
            .real(in(&S::radial_shafts, &RadialShaftSettings::decay),
                  {"radial_decay", "Radial decay",
                   "Technique radial_shafts, coverage: weight of a sample at the sun relative to one at the pixel, "
                   "exponential in between."},
                  0.01, 100, Scale::logarithmic)
            .real(in(&S::radial_shafts, &RadialShaftSettings::unseen),
                  {"radial_unseen", "Radial unseen",
                   "Technique radial_shafts: share of the sun's light that arrives where the sun is out of the "
                   "picture, and nothing is known about its way: 1 outdoors, about 0 in a closed room."},
                  0, 1)
            .integer(in(&S::light_volumes, &LightVolumeSettings::sun_size),
                     {"sun_volume_size", "Sun volume size",
                      "Texels across the box round all local media, which holds what they leave of sunlight, and "
                      "half as many along it; made anew only when media or sun change."},
                     8, 512, Effect::resource, Scale::logarithmic)
            .integer(
                in(&S::light_volumes, &LightVolumeSettings::grid_size),
                {"grid_volume_size", "Grid volume size",
                 "Most texels across the volume that holds what a density grid leaves of the sun's light, which "
                 "is else as fine as the grid's voxels; made anew only when grid or sun turn."},
                16, 512, Effect::resource, Scale::logarithmic)
            .real(in(&S::light_volumes, &LightVolumeSettings::grid_detail),
                  {"grid_volume_detail", "Grid volume detail",
                   "Texels of that volume for each voxel along the light, and twice as many across it, as far as "
                   "grid_volume_size lets them; memory and the time to make it grow with the cube."},
                  0.25, 4, Scale::logarithmic)
            .integer(in(&S::light_volumes, &LightVolumeSettings::lamp_size),
                     {"lamp_volume_size", "Lamp volume size",
                      "Directions across, and distances, of the volume that holds what local media leave of the "
                      "light of one lamp."},
                     4, 64, Effect::resource, Scale::logarithmic)
            .integer(
                in(&S::light_volumes, &LightVolumeSettings::lamp_count),
                {"lamp_volume_count", "Lamp volumes",
                 "Most lamps whose light local media attenuate, those whose range is nearest to the eye first."},
                1, 1024, Effect::resource, Scale::logarithmic)
            .integer(in(&S::shaft_geometry, &ShaftGeometrySettings::grid),
                     {"shaft_grid", "Shaft grid",
                      "Technique shaft_geometry: cells per side of the sun's mesh; edges of shafts are as fine as "
                      "a cell, time grows with the square."},
                     16, 1024, Effect::resource, Scale::logarithmic)
            .integer(in(&S::shaft_geometry, &ShaftGeometrySettings::segments),
                     {"shaft_segments", "Shaft segments",
                      "Technique shaft_geometry: closed forms per ray in a mixture of media; one homogeneous or "
                      "height medium alone needs one."},
                     1, 64, Effect::uniform, Scale::logarithmic)
            .integer(in(&S::shaft_geometry, &ShaftGeometrySettings::lamp_parts),
                     {"shaft_lamp_parts", "Shaft lamp parts",
                      "Technique shaft_geometry: closed forms, each with its own shadow, per lamp and ray."},
                     1, 64, Effect::uniform, Scale::logarithmic)
            .real(in(&S::epipolar, &EpipolarSettings::spacing),
                  {"epipolar_spacing", "Epipolar spacing",
                   "Technique epipolar: distance of the sun's lines where they are widest apart in the picture.",
                   "px"},
                  0.25, 16, Scale::logarithmic)
            .integer_of(in(&S::epipolar, &EpipolarSettings::cells),
                        {"epipolar_cells", "Epipolar cells",
                         "Technique epipolar: sun rays along each line; edges of shafts are as fine as a cell."},
                        {64, 128, 256, 512, 1024, 2048}, Effect::resource)
            .integer_of(
                in(&S::epipolar, &EpipolarSettings::step),
                {"epipolar_step", "Epipolar step",
                 "Technique epipolar: one in so many samples along each of the sun's lines, and those beside "
                 "breaks of depth, ask the trees; between them the share of sunlight is interpolated. 1: every "
                 "pixel asks."},
                {1, 2, 4, 8, 16, 32}, Effect::resource)
            .real(in(&S::epipolar, &EpipolarSettings::tolerance),
                  {"epipolar_tolerance", "Epipolar tolerance",
                   "Technique epipolar: relative difference of depth beyond which samples do not stand for each "
                   "other or for a pixel. Of use where epipolar_step is over 1."},
                  0.001, 1, Scale::logarithmic)
            .boolean(
                in(&S::epipolar, &EpipolarSettings::tree),
                {"epipolar_tree", "Epipolar tree",
                 "Technique epipolar: off, rays read every cell they cross, as without trees; to compare work."},
                Effect::uniform)
            .real(in(&S::epipolar, &EpipolarSettings::lamp_spacing),
                  {"epipolar_lamp_spacing", "Epipolar lamp spacing",
                   "Technique epipolar: distance of a lamp's lines where they are widest apart in what it lights.",
                   "px"},
                  0.25, 64, Scale::logarithmic)
            .integer_of(in(&S::epipolar, &EpipolarSettings::lamp_cells),
                        {"epipolar_lamp_cells", "Epipolar lamp cells",
                         "Technique epipolar: a lamp's rays along each line, over half a turn."},
                        {16, 32, 64, 128, 256, 512, 1024, 2048}, Effect::resource)
            .integer(
                in(&S::epipolar, &EpipolarSettings::lamp_rays),
                {"epipolar_lamp_rays", "Epipolar lamp rays",
                 "Technique epipolar: most rays of all lamps together, a pixel of the picture. Where lamps would "
                 "take more, all of them have wider spacings and fewer cells."},
                1, 1024, Effect::resource, Scale::logarithmic)
            .integer(
                in(&S::automatic, &AutoSettings::lamps),
                {"auto_lamps", "Lamps by pixel",
                 "Technique auto: most lamps that pixels take one by one, with sharp shadows, those that light "
                 "the medium most; the others are in froxels, in which shadows are soft."},
                0, 8, Effect::resource)
            .real(in(&S::automatic, &AutoSettings::least_lamp),
                  {"auto_least_lamp", "Least lamp by pixel",
                   "Technique auto: share of all lamps' light in the medium, below which a lamp is left to the "
                   "froxels; a tenth of it where no local medium is in view, for there such lamps cost little."},
                  0, 1)
            .integer(in(&S::reference, &ReferenceSettings::steps),
                     {"reference_steps", "Reference steps",
                      "Samples per ray of the technique reference, where its error falls in proportion; taken as a "
                      "multiple of 16."},
                     16, 16384, Effect::uniform, Scale::logarithmic)
            .integer(in(&S::reference, &ReferenceSettings::lamp_samples),
                     {"reference_lamp_samples", "Reference lamp samples",
                      "Samples per lamp and 16 steps of the technique reference, at equal angles as seen from the "
                      "lamp."},
                     1, 64, Effect::uniform, Scale::logarithmic)
            .integer(in(&S::reference, &ReferenceSettings::light_steps),
                     {"reference_light_steps", "Reference light steps",
                      "Samples of the technique reference between a light and a point, in each local medium that "
                      "is soft, noisy or has a height profile."},
                     1, 256, Effect::uniform, Scale::logarithmic);
    return table;
}

const SettingsTable& settings_table() {
    return growing_settings_table();
}

const std::vector<std::string>& spatial_kernel_names() {
    static const std::vector<std::string> names{"gaussian1", "box3", "box5", "binomial3", "binomial5"};
    return names;
}

const std::vector<std::string>& temporal_kernel_names() {
    static const std::vector<std::string> names{"ema", "box8"};
    return names;
}

}  // namespace tyndall::volumetrics
