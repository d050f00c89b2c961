#include "reconstruction.h"

#include "temporal.h"

namespace tyndall::volumetrics {

bool can_be_reconstructed(Technique technique) {
    return technique == Technique::ray_march || technique == Technique::froxel || technique == Technique::radial_shafts;
}

bool reads_motion(const Settings& settings) {
    return can_be_reconstructed(settings.technique) && settings.temporal != Temporal::off &&
           settings.temporal != Temporal::blend;
}

int resolution_factor(const Settings& settings) {
    return !can_be_reconstructed(settings.technique) ? 1 : 1 << static_cast<int>(settings.resolution);
}

Outputs add_reconstruction(PassList& passes, const PassResources& resources, const Inputs& inputs, const Inputs& low,
                           const Settings& settings, const Outputs& sampled, TemporalHistory& history) {
    Outputs result = sampled;
    const bool temporal = settings.temporal != Temporal::off;
    const bool before = temporal && settings.temporal_place == TemporalPlace::before;
    if (!temporal) passes.skip("volumetrics/temporal", "temporal is off");
    if (before) result = add_temporal(passes, resources, low, settings, result, history);
    if (settings.filter != Filter::none)
        result = add_filter(passes, resources, low, settings, result);
    else
        for (const char* name : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
            passes.skip(name, "filter is none");
    if (settings.resolution != Resolution::full)
        result = add_upsample(passes, resources, inputs, low, settings, result);
    else
        passes.skip("volumetrics/upsample", "resolution is full");
    if (temporal && !before) result = add_temporal(passes, resources, inputs, settings, result, history);
    return result;
}

}  // namespace tyndall::volumetrics
