#pragma once

#include "checks.h"
#include "frame.h"

namespace tyndall::stress {

/// What a filter, a history or a low resolution makes of a picture is a weighted mean of what the plain technique
/// gives around the pixel, with weights that are positive and sum to 1. A history that counts its frames and
/// forgets none is their mean at the pixel.
struct Around {
    int radius = 0;                  ///< px
    double relative = 0, floor = 0;  ///< slack
    bool blocks = false;             ///< of a low resolution
    Image least, most;               ///< of the plain frames, or their mean
    Image depth = {};                ///< m; of a low resolution
    int block = 1;                   ///< px, whose depths a low resolution takes for one another
};
/// Of a comparison of histories.
constexpr int history_frames = 3;
/// The history is the mean of all frames.
[[nodiscard]] bool counts_all_frames(const StressFrame& frame);
[[nodiscard]] Around around(const StressFrame& frame, const std::vector<Layers>& plain, Image Layers::*layer);
/// Largest excess over the range, in units of the slack; `where` is said of the worst pixel.
double compare_around(const Around& range, const Image& value, std::string& where);

}  // namespace tyndall::stress
