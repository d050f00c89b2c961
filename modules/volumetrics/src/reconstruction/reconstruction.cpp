#include "reconstruction/reconstruction.h"

#include "reconstruction/relight.h"
#include "reconstruction/temporal.h"

namespace tyndall::volumetrics {
namespace {

constexpr const char* not_sampled = "pixels sample nothing";

/// Pixels or particles stand elsewhere in each frame. Froxels have a history of their own.
bool varies_in_time(Technique technique) {
    return samples_noise(technique) || technique == Technique::particles;
}

/// Of shaft_geometry it is the shadows of lamps.
bool is_sampled(const Settings& settings, const Inputs& inputs) {
    return varies_in_time(settings.technique) &&
           (settings.technique != Technique::shaft_geometry || inputs.has_lamps);
}

}  // namespace

bool averages_frames(const Settings& settings) {
    return settings.temporal != Temporal::off && varies_in_time(settings.technique);
}

bool reads_motion(const Settings& settings) {
    return averages_frames(settings) && settings.temporal != Temporal::blend;
}

int resolution_factor(const Settings& settings) {
    const bool any = varies_in_time(settings.technique) || settings.technique == Technique::froxel;
    return any ? 1 << static_cast<int>(settings.resolution) : 1;
}

Outputs add_reconstruction(PassList& passes, const PassResources& resources, const Inputs& inputs,
                           const Inputs& low, const Settings& settings, const Outputs& sampled,
                           TemporalHistory& history) {
    return add_reconstruction(passes, resources, inputs, low, settings, MarchedLight{.rest = sampled}, history);
}

Outputs add_reconstruction(PassList& passes, const PassResources& resources, const Inputs& inputs,
                           const Inputs& low, const Settings& settings, const MarchedLight& marched,
                           TemporalHistory& history) {
    Outputs result = noisy_part(marched);
    const bool sampled = is_sampled(settings, inputs);
    const bool temporal = settings.temporal != Temporal::off && sampled;
    const bool before = temporal && settings.temporal_place == TemporalPlace::before;
    if (!temporal)
        passes.skip("volumetrics/temporal", settings.temporal == Temporal::off ? "temporal is off" : not_sampled);
    TextureRef frames;
    if (before) {
        const TemporalMean mean = add_temporal(passes, resources, low, settings, result, history);
        result = mean.light;
        if (settings.filter_narrows && settings.temporal == Temporal::accumulate) frames = mean.frames;
    }
    const TextureRef acceptance = result.acceptance;
    if (settings.filter != Filter::none && sampled && samples_noise(settings.technique))
        result = add_filter(passes, resources, low, settings, result, frames);
    else
        for (const char* name : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
            passes.skip(name, settings.filter == Filter::none ? "filter is none" : not_sampled);
    if (marched.sun || marched.lamps) result = add_relight(passes, resources, marched, result, low.count_work);
    if (settings.resolution != Resolution::full)
        result = add_upsample(passes, resources, inputs, low, settings, result);
    else
        passes.skip("volumetrics/upsample", "resolution is full");
    if (temporal && !before) return add_temporal(passes, resources, inputs, settings, result, history).light;
    result.acceptance = acceptance;
    return result;
}

}  // namespace tyndall::volumetrics
