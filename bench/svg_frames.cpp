#include "bench/svg_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/svg.h"
#include "bench/svg_plot.h"

namespace tyndall::bench {
namespace {

constexpr double left = 84, top = 96, gap_x = 18, gap_y = 44, bottom = 56, legend_width = 210;
const std::string faint = "#6b6b6b";

bool shows(double value) {
    return value > 0 && std::isfinite(value);
}

/// What all panels share.
struct Scales {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    std::size_t frames = 2;
    explicit Scales(const FramesPlot& plot) {
        for (const FramesPlot::Panel& panel : plot.panels)
            for (const FrameCurve& curve : panel.curves) {
                frames = std::max(frames, curve.values.size());
                for (const double v : curve.values)
                    if (shows(v)) low = std::min(low, v), high = std::max(high, v);
            }
        if (high <= 0) low = 1, high = 10;
        low /= 1.1;
        high *= 1.1;
    }
};

struct Area {
    glm::dvec2 corner, size;  ///< top left, px
    const Scales& scales;
    [[nodiscard]] double x(double frame) const {
        return corner.x + size.x * frame / static_cast<double>(scales.frames - 1);
    }
    [[nodiscard]] double y(double value) const {
        return corner.y + size.y * std::log(scales.high / value) / std::log(scales.high / scales.low);
    }
};

void draw_axes(Svg& svg, const Area& area, bool first_column) {
    const double right = area.corner.x + area.size.x, low = area.corner.y + area.size.y;
    for (const double value : log_ticks(area.scales.low, area.scales.high)) {
        svg.line({area.corner.x, area.y(value)}, {right, area.y(value)}, "#e6e6e6");
        if (first_column)
            svg.text({area.corner.x - 8, area.y(value) + 4}, tick_text(value), {.color = faint, .anchor = "end"});
    }
    const std::size_t step = area.scales.frames > 16 ? 8 : 4;
    for (std::size_t frame = 0; frame < area.scales.frames; frame += step) {
        const double x = area.x(static_cast<double>(frame));
        svg.line({x, area.corner.y}, {x, low}, "#f0f0f0");
        svg.text({x, low + 16}, std::to_string(frame), {.size = 11, .color = faint, .anchor = "middle"});
    }
    svg.polyline({area.corner, {area.corner.x, low}, {right, low}}, "#8a8a8a", 1);
}

void draw_spans(Svg& svg, const Area& area, const FramesPlot& plot) {
    for (const FramesPlot::Span& span : plot.spans) {
        const double a = area.x(span.first), b = area.x(span.last);
        const double low = area.corner.y + area.size.y;
        svg.polygon({{a, area.corner.y}, {b, area.corner.y}, {b, low}, {a, low}}, "#000000", 0.05);
        svg.text({(a + b) / 2, area.corner.y + 13}, span.name,
                 {.size = 11, .color = faint, .anchor = "middle", .halo = true});
    }
}

void draw_curve(Svg& svg, const Area& area, const FrameCurve& curve) {
    std::vector<glm::dvec2> path;
    for (std::size_t frame = 0; frame < curve.values.size(); ++frame)
        if (shows(curve.values[frame]))
            path.emplace_back(area.x(static_cast<double>(frame)), area.y(curve.values[frame]));
    svg.polyline(path, curve.color, curve.dashed ? 1.2 : 1.7, 0.9, curve.dashed ? "5 3" : "");
}

void draw_legend(Svg& svg, glm::dvec2 at, const FramesPlot& plot) {
    std::vector<std::string> named;
    for (const FramesPlot::Panel& panel : plot.panels)
        for (const FrameCurve& curve : panel.curves) {
            if (std::ranges::find(named, curve.name) != named.end()) continue;
            named.push_back(curve.name);
            svg.polyline({at, at + glm::dvec2(20, 0)}, curve.color, curve.dashed ? 1.2 : 2.2, 0.9,
                         curve.dashed ? "5 3" : "");
            svg.text(at + glm::dvec2(27, 4), curve.name, {});
            at.y += 20;
        }
}

}  // namespace

std::string legend_color(std::size_t n) {
    static const std::array<const char*, 10> colors{"#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9",
                                                    "#cc79a7", "#5b4b8a", "#8a8a00", "#8c564b", "#555555"};
    return colors[n % colors.size()];
}

std::string svg_frames(const FramesPlot& plot) {
    const Scales scales(plot);
    const std::size_t count = std::max<std::size_t>(plot.panels.size(), 1);
    const std::size_t columns = std::min(count, static_cast<std::size_t>(std::max(plot.columns, 1)));
    const std::size_t rows = (count + columns - 1) / columns;
    const glm::dvec2 size = columns == 1 ? glm::dvec2(600, 380) : glm::dvec2(columns == 2 ? 380 : 270, 230);
    const glm::dvec2 grid(static_cast<double>(columns) * (size.x + gap_x),
                          static_cast<double>(rows) * (size.y + gap_y));
    Svg svg({left + grid.x + legend_width, top + grid.y + bottom - gap_y + 14});
    svg.text({left, 30}, plot.title, {.size = 18, .color = "#1a1a1a", .bold = true});
    svg.text({left, 50}, plot.subtitle, {.size = 12, .color = faint});
    svg.text({22, top + (grid.y - gap_y) / 2}, plot.y_label, {.size = 13, .anchor = "middle", .turn = -90});
    svg.text({left + (grid.x - gap_x) / 2, top + grid.y - gap_y + 42}, "frame", {.size = 13, .anchor = "middle"});
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const std::size_t column = i % columns, row = i / columns;
        const Area area{{left + static_cast<double>(column) * (size.x + gap_x),
                         top + static_cast<double>(row) * (size.y + gap_y)},
                        size,
                        scales};
        draw_axes(svg, area, column == 0);
        draw_spans(svg, area, plot);
        svg.text({area.corner.x, area.corner.y - 7}, plot.panels[i].title, {.size = 13, .bold = true});
        for (const FrameCurve& curve : plot.panels[i].curves) draw_curve(svg, area, curve);
    }
    draw_legend(svg, {left + grid.x + 6, top + 8}, plot);
    return svg.finish();
}

}  // namespace tyndall::bench
