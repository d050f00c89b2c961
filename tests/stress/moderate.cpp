#include "moderate.h"

#include <algorithm>
#include <array>

namespace tyndall::stress {
namespace {

struct Turn {
    const char* technique;
    bool local, shadows;
};
constexpr std::array<Turn, moderate_turns> turns{{{"ray_march", false, false},
                                                  {"ray_march", true, false},
                                                  {"ray_march", false, true},
                                                  {"ray_march", true, true},
                                                  {"froxel", false, true},
                                                  {"froxel", true, false},
                                                  {"reference", true, true},
                                                  {"billboards", true, false},
                                                  {"particles", true, false},
                                                  {"shaft_geometry", true, true},
                                                  {"analytic_fog", true, false},
                                                  {"radial_shafts", false, false},
                                                  {"epipolar", false, true},
                                                  {"epipolar", true, true},
                                                  {"auto", false, true},
                                                  {"auto", true, true}}};

std::vector<Feature> features(const std::string& technique) {
    using enum Feature;
    if (technique == "reference" || technique == "analytic_fog") return {plain};
    if (holds_froxels(technique) || technique == "particles") return {plain, history, low_resolution};
    if (technique == "epipolar") return {plain, low_resolution};
    return {plain, filter, history, low_resolution};
}

}  // namespace

bool holds_froxels(const std::string& technique) {
    return technique == "froxel" || technique == "auto";
}

Knows knows(const std::string& technique) {
    if (technique == "analytic_fog" || technique == "radial_shafts") return {false, false, false};
    return {technique != "shaft_geometry", true, true};
}

void moderate_structure(Structure& s, int turn, Random& random) {
    const Turn& t = turns[static_cast<std::size_t>(turn)];
    volumetrics::Settings& v = s.options.volumetrics;
    s.comparable = true;
    s.size = SizeKind::thumbnail;
    s.local = t.local;
    s.options.render.shadows = t.shadows;
    if (t.shadows) s.world = World::standing;
    if (!s.sun && !s.lamps) (random.chance(0.5) ? s.sun : s.lamps) = true;
    if (!knows(t.technique).lamps) s.sun = true;
    if (!s.homogeneous && s.heights == 0 && (!t.local || random.chance(0.5))) s.heights = 1;
    s.options.volumetrics.technique = t.technique;
    v.light.lamp_integration = volumetrics::LampIntegration::segment;
    if (s.options.volumetrics.technique == "particles")
        v.light.phase = volumetrics::PhaseFunction::henyey_greenstein;
    // Its peak is narrower than what lamps' nodes resolve.
    if (s.lamps && v.light.phase == volumetrics::PhaseFunction::hg_draine)
        v.light.phase = volumetrics::PhaseFunction::cornette_shanks;
}

void moderate_visit(Structure& s, int visit) {
    const std::string technique = s.options.volumetrics.technique;
    if ((technique == "analytic_fog" || technique == "radial_shafts") && visit % 2 == 0) {
        s.heights =
            std::min(s.heights, 1);  // see bounds.cpp for what more of them meet, and for what is off screen
        if (technique == "radial_shafts") s.world = World::nothing;
    }
    const bool sprites = technique == "billboards" || technique == "particles";
    if (!(sprites || holds_froxels(technique)) || visit / 2 % 2 == 1) return;
    s.local = false;
    if (technique == "particles") s.heights = 0;
    if (s.heights == 0) s.homogeneous = true;
    if (sprites) {
        s.lamps = false;
        s.sun = true;
    }
}

void moderate_frame(StressFrame& frame, int visit, Random& of_sequence, Random& random) {
    volumetrics::Settings& v = frame.options.volumetrics;
    const std::vector<Feature> all = features(frame.options.volumetrics.technique);
    frame.feature = all[static_cast<std::size_t>(visit) % all.size()];
    const bool local = std::ranges::any_of(frame.media, is_bounded);

    if (frame.options.volumetrics.technique == "particles" && !local)
        for (Medium& medium : frame.media) {  // what particles are exact for: see bounds.cpp
            medium.anisotropy = 0;
            medium.rayleigh = false;
        }

    v.march.steps = static_cast<int>(random.logarithmic(local ? 64 : 24, 128));
    v.march.max_distance = static_cast<float>(random.logarithmic(90, local ? 120 : 400));
    v.march.stepping_strength = std::min(v.march.stepping_strength, 4.0f);
    v.froxels.distribution =
        of_sequence.pick({volumetrics::DepthDistribution::linear, volumetrics::DepthDistribution::exponential,
                          volumetrics::DepthDistribution::logarithmic});
    const bool lit = holds_froxels(frame.options.volumetrics.technique);
    v.froxels.x = v.froxels.y = lit ? 25 : 17;
    v.froxels.z = lit ? 79 : 191;
    v.froxels.far = lit ? 100.0f : 40.0f;
    v.froxels.history = frame.feature == Feature::history ? 2 + of_sequence.below(100) : 0;
    v.epipolar.lamp_cells = std::max(v.epipolar.lamp_cells, 256);
    v.light_volumes.sun_size = 48;
    v.light_volumes.lamp_size = 16;
    v.light_volumes.lamp_count = 64;
    v.billboards.layers = std::max(v.billboards.layers, 8);
    v.billboards.local_layers = std::max(v.billboards.local_layers, 16);
    v.billboards.fade = 0;
    v.particles.count = v.particles.local_count = 4096;
    if (random.chance(0.7)) v.particles.size = std::max(v.particles.size, least_particle_size);
    v.reference.steps = 512;
    v.reference.lamp_samples = 16;
    v.reference.light_steps = 16;
    v.shaft_geometry.segments = std::max(v.shaft_geometry.segments, 6);
    if (random.chance(0.7)) v.analytic_fog.mode = volumetrics::FogMode::height;

    v.filter.kernel = volumetrics::Filter::none;
    v.temporal.mode = volumetrics::Temporal::off;
    v.resolution.size = volumetrics::Resolution::full;
    switch (frame.feature) {
        case Feature::plain:
            break;
        case Feature::filter:
            v.filter.kernel = static_cast<volumetrics::Filter>(1 + random.below(7));
            break;
        case Feature::history:
            v.temporal.mode = of_sequence.chance(0.5)
                                  ? volumetrics::Temporal::accumulate
                                  : static_cast<volumetrics::Temporal>(1 + of_sequence.below(3));
            if (v.noise.kind == volumetrics::Noise::none) v.noise.kind = volumetrics::Noise::ign;
            break;
        case Feature::low_resolution:
            v.resolution.size =
                of_sequence.chance(0.5) ? volumetrics::Resolution::half : volumetrics::Resolution::quarter;
            break;
    }
    RenderSettings& r = frame.options.render;
    r.sky_visibility = false;  // its truth is slow and its volume coarse: tests/gpu/sky_visibility_test.cpp
    r.cluster_far = std::max(r.cluster_far, 100.0f);
    r.cascade_size = 1024;
    r.cascade_distance = 60;
    r.static_shadow_size = 1024;
    r.atlas_size = 2048;
    r.tile_size_max = 512;
}

StressOptions plain(StressOptions options) {
    volumetrics::Settings& v = options.volumetrics;
    v.filter.kernel = volumetrics::Filter::none;
    v.temporal.mode = volumetrics::Temporal::off;
    v.resolution.size = volumetrics::Resolution::full;
    v.froxels.history = 0;
    return options;
}

}  // namespace tyndall::stress
