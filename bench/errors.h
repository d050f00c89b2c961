#pragma once

#include "bench/ground_truth.h"
#include "bench/store.h"

namespace tyndall::bench {

/// What was compared: errors, the scattering layer as drawn, and the pixels that count (same_surface()).
struct Comparison {
    Errors errors;
    Image scattering;
    std::vector<bool> same;
};
/// Draws a point's configuration, which the session is set to, and compares it. `display`: all errors, else that of
/// the scattering layer only. Starts with no history and lets it settle.
[[nodiscard]] Comparison measure_errors(Session& session, const View& view, const Point& point,
                                        const GroundTruth& truth, bool display);

/// Pixels in which both see the same surface: view depths (0: the sky) that agree to 1%. A rasteriser snaps corners
/// to a fraction of a pixel, so that a silhouette may fall on the other side of a pixel's centre; what the medium
/// then shows is another ray's, no error of a technique.
[[nodiscard]] std::vector<bool> same_surface(const Image& depth, const Image& reference);
/// The pixels to keep, in one row.
[[nodiscard]] Image kept(const Image& image, const std::vector<bool>& keep);

/// relative_rmse() (image_metrics.h) without the brightest pixels of the reference: those whose largest channel is
/// above the quantile `part`, 0 to 1. A lamp's glow has no upper bound, and one pixel of it can outweigh a picture.
[[nodiscard]] double dim_relative_rmse(const Image& image, const Image& reference, double part);

/// Flicker, and lag after the lamps (or, where none shines, the sun) switch off. A technique whose picture does not
/// change from the first frame to the second has neither: it is believed after two frames each.
[[nodiscard]] Motion measure_motion(Session& session, const View& view, const Point& point);

/// Counts of an instrumented frame.
[[nodiscard]] gl::WorkCounts measure_work(Session& session, const View& view, const Point& point);

}  // namespace tyndall::bench
