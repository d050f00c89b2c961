#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace tyndall::bench {

/// Median, interquartile range (quartiles by linear interpolation between order statistics) and least. Not of
/// nothing.
struct MedianSpread {
    double median = 0, spread = 0, least = 0;
};
[[nodiscard]] MedianSpread median_spread(std::span<const double> values);

/// Indices of the points (x: cost, y: error) that no other beats or equals in both, from cheap to dear. Of equal
/// points the first counts. Points with a value that is not finite are never on the front.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const glm::dvec2> points);

/// y = factor * x^exponent, least squares in ln x and ln y over the points with both positive and finite.
struct PowerFit {
    double exponent = 0, factor = 0;
    double deviation = 0;        ///< root mean square of ln y - ln fit: 0.1 is about 10%
    double first = 0, last = 0;  ///< range of x it was fitted over
    std::size_t points = 0;      ///< fewer than 2, or all x equal: nothing was fitted, all else is 0
};
[[nodiscard]] PowerFit fit_power(std::span<const glm::dvec2> points);

/// Where y, falling over rising x, first reaches `target`: interpolated linearly in ln x and ln y. The first x when
/// y starts there or below; NaN when it never gets there. All values positive.
[[nodiscard]] double first_reach(std::span<const glm::dvec2> points, double target);

/// y at x, linear in ln x and ln y between neighbours (x rising), the end values outside. All values positive.
[[nodiscard]] double interpolate_log(std::span<const glm::dvec2> points, double x);

/// Of positive values; 0 if one is 0.
[[nodiscard]] double geometric_mean(std::span<const double> values);

}  // namespace tyndall::bench
