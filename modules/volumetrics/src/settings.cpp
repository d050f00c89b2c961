#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

const SettingsTable& settings_table() {
    using Effect = SettingEffect;
    using Scale = SettingScale;
    using S = Settings;
    static const SettingsTable table =
        SettingsTable("Volumetrics")
            .choice(&S::technique,
                    {"technique", "Technique", "How light in the medium is computed; off costs nothing."},
                    technique_names(), Effect::permutation)
            .integer(
                &S::steps,
                {"steps", "Steps",
                 "Segments per ray; time grows in proportion, error falls where shadow edges and local media are."},
                1, 1024, Effect::uniform, Scale::logarithmic)
            .choice(&S::stepping,
                    {"stepping", "Stepping",
                     "Equal segments, or segments that grow with distance and so are finer near the eye."},
                    {"uniform", "exponential"}, Effect::uniform)
            .real(&S::stepping_strength,
                  {"stepping_strength", "Stepping strength",
                   "Natural logarithm of the ratio of the last to the first segment of exponential stepping."},
                  0.01, 10)
            .real(&S::max_distance,
                  {"max_distance", "Maximum distance",
                   "Length of the marched ray; behind it global media go on in closed form, without shadows or "
                   "lamps.",
                   "m"},
                  1, 100000, Scale::logarithmic)
            .choice(&S::lamp_integration,
                    {"lamp_integration", "Lamp integration",
                     "Light of lamps at one point of each segment; or over the segment, with the closed form of "
                     "the inverse "
                     "square, which costs more per lamp and needs far fewer steps."},
                    {"center", "segment"}, Effect::permutation)
            .boolean(
                &S::light_transmittance,
                {"light_transmittance", "Light transmittance",
                 "Light is attenuated by global media on its way to the point that scatters it; local media do "
                 "not attenuate it, and a homogeneous medium does not attenuate the sun."},
                Effect::uniform)
            .choice(&S::phase,
                    {"phase", "Phase function",
                     "Henyey-Greenstein, or Schlick's approximation of it, which is slightly cheaper."},
                    {"henyey_greenstein", "schlick"}, Effect::uniform)
            .choice(&S::dither,
                    {"dither", "Dither",
                     "Where in its segments a pixel samples: the middle, white noise, or the Bayer matrix; costs "
                     "nothing."},
                    {"none", "white", "bayer"}, Effect::uniform)
            .integer_of(&S::dither_size,
                        {"dither_size", "Dither size",
                         "Side of the dither tile; a larger tile has more offsets and needs a wider blur.", "px"},
                        {2, 4, 8, 16}, Effect::uniform)
            .choice(
                &S::blur,
                {"blur", "Blur",
                 "Filter that removes dither noise: none, a 15-tap Gaussian, or one that stops at depth edges."},
                {"none", "gaussian", "bilateral"}, Effect::permutation)
            .real(&S::blur_sigma,
                  {"blur_sigma", "Blur sigma", "Standard deviation of the blur; beyond 3.5 the 15 taps cut it off.",
                   "px"},
                  0.3, 7)
            .real(
                &S::blur_depth_falloff,
                {"blur_depth_falloff", "Blur depth falloff",
                 "How fast the bilateral weight falls with relative depth difference: it is 0 from a difference of "
                 "1 / falloff on."},
                0, 100)
            .integer(&S::froxels_x,
                     {"froxels_x", "Froxels across",
                      "Columns of froxels over the width: local media, and all light of the technique froxel; "
                      "memory and time grow in proportion."},
                     8, 512, Effect::resource)
            .integer(&S::froxels_y, {"froxels_y", "Froxels up", "Columns of froxels over the height."}, 8, 512,
                     Effect::resource)
            .integer(&S::froxels_z, {"froxels_z", "Froxel slices", "Slices of each column in view depth."}, 8, 256,
                     Effect::resource)
            .real(&S::froxel_far,
                  {"froxel_far", "Froxel far distance",
                   "View depth where the froxels end; behind it there are no local media, and in the technique "
                   "froxel neither lamps nor shadows.",
                   "m"},
                  4, 4096, Scale::logarithmic)
            .choice(
                &S::froxel_distribution,
                {"froxel_distribution", "Froxel distribution",
                 "Slices of equal thickness; in proportion to their depth, from 1/256 of the far distance on; or "
                 "logarithmic, in between: equal near the eye, in proportion to depth far from it."},
                {"linear", "exponential", "logarithmic"}, Effect::uniform)
            .boolean(&S::froxel_jitter,
                     {"froxel_jitter", "Froxel jitter",
                      "Technique froxel: visibility is sampled at another place of each froxel, column and frame; "
                      "noise instead of bands."},
                     Effect::uniform)
            .integer(&S::reference_steps,
                     {"reference_steps", "Reference steps",
                      "Samples per ray of the technique reference, where its error falls in proportion; taken as a "
                      "multiple of 16."},
                     16, 16384, Effect::uniform, Scale::logarithmic)
            .integer(&S::reference_lamp_samples,
                     {"reference_lamp_samples", "Reference lamp samples",
                      "Samples per lamp and 16 steps of the technique reference, at equal angles as seen from the "
                      "lamp."},
                     1, 64, Effect::uniform, Scale::logarithmic)
            .integer(
                &S::reference_light_steps,
                {"reference_light_steps", "Reference light steps",
                 "Samples of the technique reference between a light and a point, in each local medium that is "
                 "soft, noisy or has a height profile."},
                1, 256, Effect::uniform, Scale::logarithmic);
    return table;
}

const std::vector<std::string>& technique_names() {
    static const std::vector<std::string> names{"off",          "ray_march",     "froxel",
                                                "billboards",   "particles",     "shaft_geometry",
                                                "analytic_fog", "radial_shafts", "reference"};
    return names;
}

}  // namespace tyndall::volumetrics
