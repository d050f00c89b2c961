#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tools/noise/volume.h"

namespace tyndall::noise {

/// What makes two values v, v' of a volume disturb each other:
///     E = - sum over pairs of one slice of space(|dx|) space(|dy|) |v - v'| - sum over pairs of one pixel of
///     time(|dz|) |v - v'|.
/// Apart from a constant that is the error of every threshold at once: v < s is 1 for a share s of all places, and
/// the mean of (1[v < s] - s)(1[v' < s] - s) over s is a function of each value alone minus |v - v'| / 2. Shadow
/// edges are thresholds; squares of the values themselves would have other minima, which are no better than white
/// noise there. With the autocorrelation of a filter E is the sum of squares behind it: FAST (Donnelly, Wolfe,
/// Bütepage, Valdés 2024, "separate" filters in space and time). With Gaussians it is close to spatio-temporal blue
/// noise (Wolfe, Morrical, Akenine-Möller, Ramamoorthi 2022) and, in space alone, to void-and-cluster (Ulichney
/// 1993).
struct Energy {
    std::vector<double> space;  ///< at distances 0, 1, … px; 0 beyond; 1 to 9 values
    std::vector<double> time;   ///< at distances 0 … depth - 1, cyclic; empty: slices are independent
};

/// Side 128, 32 slices. Each slice holds each byte equally often: swaps within a slice keep the histogram it begins
/// with. A swap is made when it lowers E, in `sweeps` times as many trials as there are values, for one energy
/// after the other: the wide ones of filters have many poor minima, and what a narrow one has ordered leads to
/// better. All arithmetic behind the kernels is in integers: the same seed gives the same bytes on any machine.
/// progress(share done) is called now and then.
[[nodiscard]] Volume generate(const std::vector<Energy>& energies, std::uint64_t seed, int sweeps,
                              const std::function<void(double)>& progress = {});

}  // namespace tyndall::noise
