#include "sample_game/statistics.h"

#include <cmath>
#include <numeric>

namespace tyndall {

Statistics statistics(std::span<const double> values) {
    Statistics s;
    s.count = values.size();
    if (values.empty()) return s;
    const double n = static_cast<double>(values.size());
    s.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    for (const double v : values) s.variance += (v - s.mean) * (v - s.mean) / n;
    s.deviation = std::sqrt(s.variance);
    return s;
}

}  // namespace tyndall
