#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/svg.h"
#include "bench/svg_plot.h"

namespace tyndall::bench {
namespace {

constexpr double left = 120, right = 690, top = 76, row_height = 44, bar_height = 26, legend_x = 716;
/// Okabe and Ito's, that all kinds of colour vision tell apart, and their neighbours.
const std::array<const char*, 10> colors{"#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9",
                                         "#cc79a7", "#5b4b8a", "#b8a200", "#8c564b", "#7f7f7f"};

/// A round number not below value / 5: 1, 2 or 5 of a decade.
double round_step(double value) {
    const double raw = value / 5, decade = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double m : {1.0, 2.0, 5.0})
        if (m * decade >= raw) return m * decade;
    return 10 * decade;
}

}  // namespace

std::string svg_bars(const BarChart& chart) {
    const double rows = static_cast<double>(chart.rows.size());
    const double bottom = top + rows * row_height + 8;
    double longest = 1e-9;
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
        double sum = 0;
        for (const BarChart::Part& part : chart.parts) sum += part.values[r];
        longest = std::max(longest, sum);
    }
    const double scale = (right - left) / (longest * 1.04);
    const double legend_bottom = top + 10 + 20 * static_cast<double>(chart.parts.size());
    Svg svg({960, std::max(bottom + 56, legend_bottom + 10)});
    svg.text({left, 30}, chart.title, {.size = 18, .color = "#1a1a1a", .bold = true});
    svg.text({left, 50}, chart.subtitle, {.size = 12, .color = "#6b6b6b"});
    const double step = round_step(longest);
    for (double value = 0; value <= longest * 1.04; value += step) {
        const double x = left + value * scale;
        svg.line({x, top - 6}, {x, bottom}, "#e6e6e6");
        svg.text({x, bottom + 18}, value == 0 ? "0" : tick_text(value), {.color = "#6b6b6b", .anchor = "middle"});
    }
    svg.text({(left + right) / 2, bottom + 42}, chart.x_label, {.size = 13, .anchor = "middle"});
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
        const double y = top + static_cast<double>(r) * row_height + (row_height - bar_height) / 2;
        svg.text({left - 10, y + bar_height / 2 + 4}, chart.rows[r], {.size = 13, .anchor = "end"});
        double x = left;
        for (std::size_t p = 0; p < chart.parts.size(); ++p) {
            const double width = chart.parts[p].values[r] * scale;
            if (width <= 0) continue;
            svg.rectangle({x, y}, {width, bar_height}, colors[p % colors.size()],
                          fmt::format("{}: {:.3g}", chart.parts[p].name, chart.parts[p].values[r]));
            x += width;
        }
    }
    for (std::size_t p = 0; p < chart.parts.size(); ++p) {
        const double y = top + 4 + 20 * static_cast<double>(p);
        svg.rectangle({legend_x, y}, {12, 12}, colors[p % colors.size()]);
        svg.text({legend_x + 20, y + 10}, chart.parts[p].name, {});
    }
    return svg.finish();
}

}  // namespace tyndall::bench
