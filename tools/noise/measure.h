#pragma once

#include <string>
#include <vector>

#include "tools/noise/volume.h"

namespace tyndall::noise {

/// Variance of the filtered volume over what the same filter leaves of white noise of the same variance: 1 for
/// white noise, less is better. Filters by name (filters.h); an empty name: none.
[[nodiscard]] double filtered_variance(const Volume& volume, const std::string& spatial,
                                       const std::string& temporal);

/// Every byte is in every slice equally often.
[[nodiscard]] bool has_uniform_slices(const Volume& volume);

/// Mean power of the slices' Fourier transforms over rings of frequency [k, k + 1) cycles per side, k = 0 … side/2
/// - 1, without the mean value: 1 for white noise.
[[nodiscard]] std::vector<double> spatial_spectrum(const Volume& volume);
/// The same along time: frequencies 1 … depth/2 cycles per period, at index frequency - 1.
[[nodiscard]] std::vector<double> temporal_spectrum(const Volume& volume);

}  // namespace tyndall::noise
