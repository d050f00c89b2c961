#include "bench/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/svg.h"

namespace tyndall::bench {
namespace {

constexpr glm::dvec2 page{960, 560};        ///< wider where the legend is
constexpr glm::dvec2 low_corner{92, 488};   ///< of the axes, px
constexpr glm::dvec2 high_corner{690, 66};  ///< the opposite one
constexpr double legend_x = 714;
const std::string grid = "#e6e6e6", fine_grid = "#f4f4f4", ink = "#333333", faint = "#6b6b6b";

bool shows(glm::dvec2 p) {
    return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// From data to page, logarithmic.
struct Frame {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{0};

    void add(glm::dvec2 p) {
        if (!shows(p)) return;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    /// Some room around the data; at least a factor of 2 in all.
    void close() {
        if (high.x <= 0) low = glm::dvec2(1), high = glm::dvec2(10);
        for (int i = 0; i < 2; ++i) {
            const double room =
                std::pow(std::max(high[i] / low[i], 1.6), 0.06) * (high[i] / low[i] < 1.6 ? 1.3 : 1);
            low[i] /= room;
            high[i] *= room;
        }
    }
    [[nodiscard]] glm::dvec2 at(glm::dvec2 p) const {
        const glm::dvec2 t = glm::log(p / low) / glm::log(high / low);
        return low_corner + t * (high_corner - low_corner);
    }
};

void draw_axes(Svg& svg, const Plot& plot, const Frame& frame) {
    for (int axis = 0; axis < 2; ++axis) {
        const auto across = [&](double value, const std::string& color) {
            glm::dvec2 a = frame.low, b = frame.high;
            a[axis] = b[axis] = value;
            svg.line(frame.at(a), frame.at(b), color);
        };
        const double first = std::floor(std::log10(frame.low[axis])), last = std::log10(frame.high[axis]);
        for (double decade = first; decade <= last; ++decade)
            for (int i = 1; i < 10; ++i) {
                const double value = i * std::pow(10.0, decade);
                if (value > frame.low[axis] && value < frame.high[axis]) across(value, fine_grid);
            }
        for (const double value : log_ticks(frame.low[axis], frame.high[axis])) {
            across(value, grid);
            glm::dvec2 p = frame.low;
            p[axis] = value;
            const glm::dvec2 at = frame.at(p);
            if (axis == 0)
                svg.text(at + glm::dvec2(0, 18), tick_text(value), {.color = faint, .anchor = "middle"});
            else
                svg.text(at + glm::dvec2(-8, 4), tick_text(value), {.color = faint, .anchor = "end"});
        }
    }
    svg.polyline({{low_corner.x, high_corner.y}, low_corner, {high_corner.x, low_corner.y}}, "#8a8a8a", 1);
    const glm::dvec2 middle = (low_corner + high_corner) / 2.0;
    svg.text({middle.x, low_corner.y + 44}, plot.x_label, {.size = 13, .anchor = "middle"});
    svg.text({22, middle.y}, plot.y_label, {.size = 13, .anchor = "middle", .turn = -90});
    svg.text({low_corner.x, 30}, plot.title, {.size = 18, .color = "#1a1a1a", .bold = true});
    svg.text({low_corner.x, 50}, plot.subtitle, {.size = 12, .color = faint});
}

std::vector<glm::dvec2> path_of(const std::vector<glm::dvec2>& curve, const Frame& frame) {
    std::vector<glm::dvec2> path;
    for (const glm::dvec2 p : curve)
        if (shows(p)) path.push_back(frame.at(p));
    return path;
}

/// Steps from one point of the front to the next, from the top of the frame to its right edge.
std::vector<glm::dvec2> stairs(const std::vector<glm::dvec2>& front, const Frame& frame) {
    std::vector<glm::dvec2> path;
    for (const glm::dvec2 p : front) {
        if (!shows(p)) continue;
        const glm::dvec2 at = frame.at(p);
        path.emplace_back(at.x, path.empty() ? high_corner.y : path.back().y);
        path.push_back(at);
    }
    if (!path.empty()) path.emplace_back(high_corner.x, path.back().y);
    return path;
}

void draw_front(Svg& svg, const std::vector<glm::dvec2>& path) {
    if (path.empty()) return;
    std::vector<glm::dvec2> behind = path;
    behind.emplace_back(high_corner.x, high_corner.y);
    svg.polygon(behind, "#000000", 0.025);
    svg.polyline(path, "#1a1a1a", 1.8, 0.85);
}

class Labels {
  public:
    /// Writes `text` above, right, below or left of a point, where no label lies and no axis ends.
    void add(Svg& svg, glm::dvec2 at, const std::string& text, const std::string& color) {
        const glm::dvec2 size(6.4 * double(text.size()), 11);
        const glm::dvec2 places[] = {{-size.x / 2, -8}, {-size.x - 7, 11}, {7, -4}, {-size.x / 2, 17}};
        for (const glm::dvec2 offset : places) {
            const glm::dvec2 low = at + offset - glm::dvec2(0, size.y), high = low + size;
            const bool outside = low.x < low_corner.x + 2 || high.x > high_corner.x || low.y < high_corner.y ||
                                 high.y > low_corner.y - 2;
            const bool taken = std::ranges::any_of(boxes_, [&](const auto& b) {
                return low.x < b[1].x && high.x > b[0].x && low.y < b[1].y && high.y > b[0].y;
            });
            if (outside || taken) continue;
            boxes_.push_back({low, high});
            svg.text(at + offset, text, {.size = 11, .color = color, .bold = true, .halo = true});
            return;
        }
    }

  private:
    std::vector<std::array<glm::dvec2, 2>> boxes_;
};

void draw_legend(Svg& svg, const Plot& plot) {
    double y = high_corner.y + 6;
    if (!plot.front_name.empty()) {
        svg.polyline({{legend_x - 8, y - 6}, {legend_x, y - 6}, {legend_x, y + 2}, {legend_x + 8, y + 2}},
                     "#1a1a1a", 1.8, 0.85);
        svg.text({legend_x + 18, y + 2}, plot.front_name, {});
        y += 24;
    }
    for (const PlotSeries& s : plot.series) {
        if (!s.curves.empty())
            svg.polyline({{legend_x - 9, y - 2}, {legend_x + 9, y - 2}}, s.color, 1.4, 0.8, s.dashed ? "5 3" : "");
        if (!s.points.empty()) svg.marker(s.marker, {legend_x, y - 2}, 5, s.color);
        svg.text({legend_x + 18, y + 2}, s.name, {});
        y += 21;
    }
    y += 6;
    for (const std::string& note : plot.notes) {
        svg.text({legend_x - 8, y + 2}, note, {.size = 11, .color = faint});
        y += 15;
    }
}

}  // namespace

std::string svg_plot(const Plot& plot) {
    Frame frame;
    for (const PlotSeries& s : plot.series) {
        for (const PlotPoint& p : s.points) frame.add(p.at);
        for (const auto& curve : s.curves)
            for (const glm::dvec2 p : curve) frame.add(p);
    }
    frame.close();
    std::size_t longest = 0;
    for (const PlotSeries& s : plot.series) longest = std::max(longest, s.name.size());
    Svg svg({std::max(page.x, legend_x + 26 + 6.6 * static_cast<double>(longest)), page.y});
    draw_axes(svg, plot, frame);
    for (const PlotSeries& s : plot.series) {
        for (const auto& curve : s.curves)
            svg.polyline(path_of(curve, frame), s.color, 1.4, s.dashed ? 0.8 : 0.6, s.dashed ? "5 3" : "");
    }
    draw_front(svg, stairs(plot.front, frame));
    for (const PlotSeries& s : plot.series)
        for (const PlotPoint& p : s.points)
            if (shows(p.at)) svg.marker(s.marker, frame.at(p.at), 4.4, s.color, p.tooltip);
    Labels labels;
    for (const PlotSeries& s : plot.series)
        for (const PlotPoint& p : s.points)
            if (shows(p.at) && !p.label.empty()) labels.add(svg, frame.at(p.at), p.label, s.color);
    draw_legend(svg, plot);
    return svg.finish();
}

}  // namespace tyndall::bench
