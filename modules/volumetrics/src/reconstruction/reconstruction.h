#pragma once

#include "frame/passes.h"

namespace tyndall::volumetrics {

class TemporalHistory;
struct MarchedLight;

/// What techniques that sample draw to: `inputs` with the size and the depth of the chosen resolution. At full
/// resolution these are the host's.
[[nodiscard]] Inputs add_depth_downsample(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                          const Settings& settings);
/// `inputs` are those of full resolution: their depth can hide what is drawn.
[[nodiscard]] bool is_depth_buffer(const PassList& passes, const Inputs& inputs);
/// A mean over frames is asked for, of a technique whose samples differ from frame to frame.
[[nodiscard]] bool averages_frames(const Settings& settings);
/// Pixels of the host along each side of one pixel of that: 1, 2 or 4.
[[nodiscard]] int resolution_factor(const Settings& settings);

/// Between samples and picture, each where settings ask for it:
///     temporal (before) -> spatial filter -> relight -> up-sampling -> temporal (after)
/// The filter only where the technique's pixels sample at noise, temporal there and for particles.
/// `sampled` is of the size of `low` (add_depth_downsample); the result is of the host's. Every texture of
/// `sampled` goes the same way.
[[nodiscard]] Outputs add_reconstruction(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                         const Inputs& low, const Settings& settings, const Outputs& sampled,
                                         TemporalHistory& history);

/// The same, of which the steps before relight take noisy_part() alone.
[[nodiscard]] Outputs add_reconstruction(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                         const Inputs& low, const Settings& settings, const MarchedLight& marched,
                                         TemporalHistory& history);

/// The spatial filter, two passes at the resolution of `source`; settings.filter is not none. With `frames` (y:
/// frames in the mean that each pixel of `source` is) the kernel is the narrower the more there are.
[[nodiscard]] Outputs add_filter(PassList& passes, const PassResources& resources, const Inputs& low,
                                 const Settings& settings, const Outputs& source, TextureRef frames);
/// From the resolution of `low` to the host's.
[[nodiscard]] Outputs add_upsample(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                   const Inputs& low, const Settings& settings, const Outputs& source);
struct TemporalMean {
    Outputs light;      ///< with Outputs::acceptance
    TextureRef frames;  ///< float, y: frames in the mean, 1 … 256
};
/// The mean over frames at the resolution of `at`, settings.temporal is not off.
[[nodiscard]] TemporalMean add_temporal(PassList& passes, const PassResources& resources, const Inputs& at,
                                        const Settings& settings, const Outputs& source, TemporalHistory& history);

}  // namespace tyndall::volumetrics
