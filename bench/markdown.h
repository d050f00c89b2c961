#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace tyndall::bench {

/// Three digits; a dash for what is not finite.
[[nodiscard]] inline std::string three(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

/// A Markdown table; the first row is its head. Rows have equally many cells.
[[nodiscard]] std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace tyndall::bench
