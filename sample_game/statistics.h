#pragma once

#include <span>

namespace tyndall {

/// Mean, standard deviation and variance (population, n in the denominator) of a series of times.
struct Statistics {
    std::size_t count = 0;
    double mean = 0, deviation = 0, variance = 0;
};
[[nodiscard]] Statistics statistics(std::span<const double> values);

}  // namespace tyndall
