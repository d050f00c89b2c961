#pragma once

#include "checks.h"
#include "random.h"

namespace tyndall::stress {

/// What comparisons with the ground truth found over many frames.
struct Comparison {
    int frames = 0;
    int pixels = 0;    ///< whose scattering was compared
    double worst = 0;  ///< largest error over its bound
};

/// Compares some pixels of a frame that is marked comparable with the CPU's ground truth. Such a frame has no
/// shadow maps, no local media, no filter, no history, full resolution, 8 to 128 steps, segment integration of
/// lamps, extinctions of 1e-4 to 0.9 /m, |g| up to 0.6, lamps within 25 m whose range ends before the march does.
///
/// Bounds, for an error |gpu - truth|:
///     transmittance   1e-3 + 1e-3 truth
///     scattering      b truth + 2e-3 mean of the picture,
///                     b = 4e-3 + 0.02 (ambient) + 0.1 v (several media) + 0.03 + 0.4 / steps (lamps)
/// with v the number of times that the density of a height medium grows e-fold over the longest segment. A segment
/// takes the means of a mixture's parts, and lamps four nodes: where v > 1, or where a mixture with a height medium
/// goes on behind the march, scattering is left out. Half floats round by 5e-4; the module's README gives what the
/// closed forms leave out. Truth beyond 65504 is that.
void compare_with_truth(const StressFrame& frame, const Scene& scene, const Layers& layers, Random& random,
                        Comparison& total, Findings& findings);

}  // namespace tyndall::stress
