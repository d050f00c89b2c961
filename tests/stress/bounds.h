#pragma once

#include <string>

#include "truth.h"

namespace tyndall::stress {

/// Of an error: `relative` times the truth, plus `floor`. A rule: the value is not compared, and why.
struct Bound {
    double relative = 0, floor = 0;
    std::string rule = {};
};

/// See bounds.cpp for where each figure comes from.
[[nodiscard]] Bound transmittance_bound(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel);
/// Of scattering without shadows; the floor is to be multiplied by the mean of the picture.
[[nodiscard]] Bound scattering_bound(const StressFrame& frame, const Truth& truth, const Truth::Pixel& pixel);
/// Of the mean error of a frame's pixels with shadows, over the mean of the light without them.
[[nodiscard]] double shadow_bound(const StressFrame& frame);

/// The filter and the mean over frames see the visible share of light alone.
[[nodiscard]] bool filters_shares(const StressFrame& frame);
/// Why the featured picture is no mean of plain ones; empty: it is.
[[nodiscard]] std::string light_differs_from_plain(const StressFrame& frame);
[[nodiscard]] std::string differs_from_plain(const StressFrame& frame, bool shadows);

}  // namespace tyndall::stress
