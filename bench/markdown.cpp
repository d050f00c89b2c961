#include "bench/markdown.h"

#include <fmt/ranges.h>

namespace tyndall::bench {

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
    std::string md;
    for (const std::vector<std::string>& row : rows) {
        md += fmt::format("| {} |\n", fmt::join(row, " | "));
        if (&row != &rows.front()) continue;
        for (std::size_t i = 0; i < row.size(); ++i) md += "|---";
        md += "|\n";
    }
    return md + "\n";
}

}  // namespace tyndall::bench
