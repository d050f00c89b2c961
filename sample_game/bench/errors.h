#pragma once

#include "sample_game/bench/ground_truth.h"
#include "sample_game/bench/store.h"

namespace tyndall::bench {

/// Draws a point's configuration, which the session is set to, and compares it. `display`: all errors, else that of
/// the scattering layer only. Starts with no history and lets it settle.
[[nodiscard]] Errors measure_errors(Session& session, const View& view, const Point& point,
                                    const GroundTruth& truth, bool display);

/// relative_rmse() (image_metrics.h) without the brightest pixels of the reference: those whose largest channel is
/// above the quantile `kept`, 0 to 1. A lamp's glow has no upper bound, and one pixel of it can outweigh a picture.
[[nodiscard]] double dim_relative_rmse(const Image& image, const Image& reference, double kept);

/// Flicker, and lag after the lamps (or, where none shines, the sun) switch off. A technique whose picture does not
/// change from the first frame to the second has neither: it is believed after two frames each.
[[nodiscard]] Motion measure_motion(Session& session, const View& view, const Point& point);

/// Counts of an instrumented frame.
[[nodiscard]] gl::WorkCounts measure_work(Session& session, const View& view, const Point& point);

}  // namespace tyndall::bench
