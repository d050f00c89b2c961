#include "tally.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::stress {

void Tally::add(const std::string& technique, const std::string& what, int pixels, double worst) {
    if (pixels == 0) return;
    Row& row = rows_[{technique, what}];
    ++row.frames;
    row.pixels += pixels;
    row.worst = std::max(row.worst, worst);
}

std::string Tally::table() const {
    std::string all =
        fmt::format("{:16} {:44} {:>6} {:>8} {:>12}\n", "technique", "compared", "frames", "pixels", "error/bound");
    for (const auto& [key, row] : rows_)
        all += fmt::format("{:16} {:44} {:6} {:8} {:12.2f}\n", key.first, key.second, row.frames, row.pixels,
                           row.worst);
    for (const auto& [rule, pixels] : left_out_) all += fmt::format("left out: {:6} pixels, {}\n", pixels, rule);
    return all;
}

long long Tally::pixels() const {
    long long sum = 0;
    for (const auto& [key, row] : rows_) sum += row.pixels;
    return sum;
}

}  // namespace tyndall::stress
