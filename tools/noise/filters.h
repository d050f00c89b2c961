#pragma once

#include <string>
#include <vector>

namespace tyndall::noise {

/// The filters that noise is made for, and measured with. Taps sum to 1.
///
/// In space, applied along x and then y; an odd number of taps, the middle one at the pixel: gaussian1 (standard
/// deviation 1 px), box3, box5, binomial3, binomial5. Throws std::invalid_argument for another name.
[[nodiscard]] std::vector<double> spatial_taps(const std::string& name);
/// In time; taps.at(i) belongs to the frame i before this one, over a period of `depth` frames that repeats: ema
/// (weight 0.1 for each new frame), box8 (the mean of 8 frames).
[[nodiscard]] std::vector<double> temporal_taps(const std::string& name, int depth);

[[nodiscard]] const std::vector<std::string>& spatial_filter_names();
[[nodiscard]] const std::vector<std::string>& temporal_filter_names();

/// sum_i taps[i] taps[i + d] for d = 0, 1, … taps.size() - 1.
[[nodiscard]] std::vector<double> autocorrelation(const std::vector<double>& taps);
/// The same for a signal that repeats after taps.size().
[[nodiscard]] std::vector<double> cyclic_autocorrelation(const std::vector<double>& taps);

}  // namespace tyndall::noise
