#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "bench/techniques.h"

namespace tyndall::bench {

struct PlotPoint {
    glm::dvec2 at;
    std::string label;    ///< beside it, where there is room
    std::string tooltip;  ///< under the pointer
};

/// One look and one entry of the legend.
struct PlotSeries {
    std::string name;
    std::string color;
    Marker marker = Marker::circle;
    std::vector<PlotPoint> points;
    std::vector<std::vector<glm::dvec2>> curves;  ///< thin lines
    bool dashed = false;                          ///< the curves are
};

/// A log-log plot. Points that are not positive and finite in both do not show.
struct Plot {
    std::string title, subtitle;
    std::string x_label, y_label;  ///< with units
    std::vector<PlotSeries> series;
    std::vector<glm::dvec2> front;  ///< drawn as stairs: what is behind them is beaten; x rising, y falling
    std::string front_name;
    std::vector<std::string> notes;  ///< below the legend
};
[[nodiscard]] std::string svg_plot(const Plot& plot);

/// Values at which a logarithmic axis from `low` to `high` (> low > 0) has labels: 1, 2, 5 … of each decade, more
/// or fewer of them by the room there is.
[[nodiscard]] std::vector<double> log_ticks(double low, double high);
/// 0.001, 0.5, 20, 10,000; beyond 0.0001 and 1,000,000 as a power of ten.
[[nodiscard]] std::string tick_text(double value);

struct BarChart {
    std::string title, subtitle, x_label;
    std::vector<std::string> rows;
    struct Part {
        std::string name;
        std::vector<double> values;  ///< one for each row, >= 0
    };
    std::vector<Part> parts;
};
/// Stacked horizontal bars on a linear axis.
[[nodiscard]] std::string svg_bars(const BarChart& chart);

}  // namespace tyndall::bench
