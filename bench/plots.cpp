#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "bench/reports.h"
#include "bench/sampling.h"
#include "bench/svg_plot.h"

namespace tyndall::bench {
namespace {

using Pictures = std::map<std::string, std::string>;

const std::string time_label = "time of volumetrics (ms per frame)";
const std::string error_label = "relative RMSE of scattering";

/// A point of an error/time plot: where, and which configuration it is.
struct Shown {
    glm::dvec2 at;
    const Point* point;
};

/// One series for each family, its curves joined over the count that buys accuracy, and the front over all.
Plot error_over_time(const std::vector<Shown>& measured) {
    Plot plot;
    plot.x_label = time_label;
    plot.y_label = error_label;
    plot.front_name = "best error within a time";
    std::vector<Shown> shown;  // competitors
    for (const Shown& s : measured)
        if (!family(s.point->configuration.family).limit) shown.push_back(s);
    std::vector<glm::dvec2> all;
    double first = std::numeric_limits<double>::infinity(), last = 0;
    for (const Shown& s : shown) {
        all.push_back(s.at);
        first = std::min(first, s.at.x);
        last = std::max(last, s.at.x);
    }
    const std::vector<std::size_t> front = pareto_front(all);
    for (const std::size_t i : front) plot.front.push_back(all[i]);
    for (const Family& f : families()) {
        PlotSeries series{f.name, f.color, f.marker, {}, {}};
        std::vector<glm::dvec2> curve;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const Configuration& c = shown[i].point->configuration;
            if (c.family != f.name) continue;
            const bool best = std::ranges::find(front, i) != front.end();
            series.points.push_back({shown[i].at, best ? c.label : "",
                                     fmt::format("{}: {:.3g} ms, {:.3g}", c.name(), shown[i].at.x, shown[i].at.y)});
            curve.push_back(shown[i].at);
        }
        series.curves.push_back(curve);
        if (!series.points.empty()) plot.series.push_back(std::move(series));
    }
    for (const Shown& s : measured) {
        const Family& f = family(s.point->configuration.family);
        if (!f.limit || shown.empty()) continue;
        PlotSeries level{
            f.name + ": the shadow maps' error", f.color, f.marker, {}, {{{first, s.at.y}, {last, s.at.y}}}};
        level.dashed = true;
        plot.series.push_back(std::move(level));
    }
    plot.notes = {"Numbers: the setting that costs", "time, of points on the front"};
    return plot;
}

Pictures error_time_plots(const std::vector<Row>& rows, const std::string& machine) {
    Pictures pictures;
    for (const std::string& place : place_names(rows)) {
        std::vector<Shown> shown;
        for (const Row& row : of_place(rows, place))
            if (row.timed() && row.compared()) shown.push_back({row.cost_and_error(), row.point});
        if (shown.empty()) continue;
        Plot plot = error_over_time(shown);
        plot.title = "Error against time: " + place;
        plot.subtitle = machine;
        pictures[place] = svg_plot(plot);
    }
    const std::vector<Mean> average = means(rows);
    if (average.empty() || place_names(rows).size() < 2) return pictures;
    const std::vector<std::tuple<std::string, std::string, double Mean::*>> overviews{
        {"overview", error_label, &Mean::error},
        {"overview_dim", error_label + ", without the brightest 2%", &Mean::dim},
        {"overview_flip", "HDR FLIP of the picture (mean)", &Mean::flip}};
    for (const auto& [name, label, member] : overviews) {
        std::vector<Shown> shown;
        for (const Mean& m : average) shown.push_back({{m.time, m.*member}, m.point});
        Plot plot = error_over_time(shown);
        plot.title = fmt::format("Error against time over {} places", place_names(rows).size());
        plot.subtitle = "Geometric means. " + machine;
        plot.y_label = label;
        pictures[name] = svg_plot(plot);
    }
    return pictures;
}

PlotSeries line_series(const Fitted& line, const std::string& name, const PowerFit& fit) {
    PlotSeries series{name, line.color, line.marker, {}, {}};
    for (const glm::dvec2 p : line.points)
        series.points.push_back({p, "", fmt::format("{}: {:.6g}, {:.3g}", line.name, p.x, p.y)});
    series.dashed = true;
    if (fit.points > 1) {
        const auto at = [&](double x) { return glm::dvec2(x, fit.factor * std::pow(x, fit.exponent)); };
        series.curves.push_back({at(fit.first), at(fit.last)});
    }
    return series;
}

Pictures scaling_plots(const Suite& suite, const std::vector<Row>& rows, const std::string& machine) {
    const std::map<std::string, std::string> labels{{"pixels", "pixels"},
                                                    {"steps", "steps per ray"},
                                                    {"lamps", "lamps in the scene"},
                                                    {"media", "spheres of medium in view"},
                                                    {"froxels", "froxels"}};
    std::map<std::string, Plot> plots;
    for (const Fitted& line : fitted_lines(suite, rows)) {
        Plot& plot = plots[line.variable];
        plot.title = "Cost against " + line.variable;
        plot.subtitle = machine;
        plot.x_label = labels.at(line.variable);
        plot.y_label = time_label;
        plot.notes = {"Dashed: power law through the", "upper half of the points"};
        plot.series.push_back(
            line_series(line, fmt::format("{}: exponent {:.2f}", line.place, line.end.exponent), line.end));
    }
    Pictures pictures;
    for (const auto& [variable, plot] : plots) pictures[variable] = svg_plot(plot);
    return pictures;
}

Pictures convergence_plots(const Suite& suite, const std::vector<Row>& rows, const std::string& machine) {
    std::map<std::string, Plot> plots;
    for (const Fitted& line : fitted_lines(suite, rows)) {
        Plot& plot = plots[line.place];
        plot.title = "Convergence: " + line.place;
        plot.subtitle = "ray_march, equal steps, no blur. " + machine;
        plot.x_label = "steps per ray";
        plot.y_label = error_label;
        plot.notes = {"Dashed: power law through the", "upper half of the points"};
        plot.series.push_back(
            line_series(line, fmt::format("{}: order {:.2f}", line.name, -line.end.exponent), line.end));
    }
    Pictures pictures;
    for (const auto& [place, plot] : plots) pictures[place] = svg_plot(plot);
    return pictures;
}

/// Error of undithered steps over that of eight dithered ones: where a line falls below 1, they are equal.
Pictures headline_plots(const std::vector<Row>& rows, const std::string& machine) {
    Plot plot;
    plot.title = "Undithered steps that equal 8 dithered ones";
    plot.subtitle = "Eight steps with Bayer dither and bilateral blur are the line at 1. " + machine;
    plot.x_label = "undithered steps";
    plot.y_label = "error, relative to 8 dithered steps";
    const std::vector<std::string> places = place_names(rows);
    const std::array<const char*, 6> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#5b4b8a"};
    double first = 8, last = 16;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::vector<Row> some = of_place(rows, places[i]);
        const Headline h = headline(some);
        if (h.error <= 0) continue;
        const std::string found = std::isfinite(h.steps) ? fmt::format("{:.0f}", h.steps) : "never";
        PlotSeries series{
            places[i] + ": " + found, colors[i % colors.size()], static_cast<Marker>(i % 8), {}, {{}}};
        for (std::size_t r = 1; r < some.size(); ++r) {
            if (!some[r].compared()) continue;
            const glm::dvec2 at(some[r].point->value, some[r].measured->errors->scattering / h.error);
            series.points.push_back(
                {at, "", fmt::format("{}: {:.0f} steps, {:.3g} times the error", places[i], at.x, at.y)});
            series.curves[0].push_back(at);
            last = std::max(last, at.x);
        }
        plot.series.push_back(std::move(series));
    }
    if (plot.series.empty()) return {};
    plot.series.push_back({"8 dithered steps", "#1a1a1a", Marker::circle, {}, {{{first, 1}, {last, 1}}}, true});
    return {{"headline", svg_plot(plot)}};
}

Pictures pass_plots(const std::vector<Row>& rows, const std::string& machine) {
    BarChart chart;
    chart.title = "Time of each pass";
    chart.subtitle = machine;
    chart.x_label = "time (ms per frame, medians)";
    double longest = 0;
    for (const Row& row : rows) longest = std::max(longest, row.frame.median);
    std::vector<std::string> shown;  // passes that are to be seen; the rest is one part
    for (const Row& row : rows)
        for (const auto& [pass, ms] : row.passes)
            if (ms > 0.01 * longest && std::ranges::find(shown, pass) == shown.end() && shown.size() < 9)
                shown.push_back(pass);
    for (const std::string& pass : shown) chart.parts.push_back({pass, {}});
    chart.parts.push_back({"all others", {}});
    for (const Row& row : rows) {
        if (!row.timed()) continue;
        chart.rows.push_back(row.point->place->name);
        for (BarChart::Part& part : chart.parts) part.values.push_back(0);
        for (const auto& [pass, ms] : row.passes) {
            const auto index = static_cast<std::size_t>(std::ranges::find(shown, pass) - shown.begin());
            chart.parts[index].values.back() += ms;
        }
    }
    if (chart.rows.empty()) return {};
    return {{"passes", svg_bars(chart)}};
}

}  // namespace

Pictures make_plots(const Suite& suite, const std::vector<Row>& rows, const std::string& machine) {
    if (suite.name == "scaling") return scaling_plots(suite, rows, machine);
    if (suite.name == "convergence") return convergence_plots(suite, rows, machine);
    if (suite.name == "headline") return headline_plots(rows, machine);
    if (suite.name == "passes") return pass_plots(rows, machine);
    if (suite.name == "resolution") return {};
    if (suite.name == "ingredients") return ingredient_plots(rows, machine);
    return error_time_plots(rows, machine);
}

}  // namespace tyndall::bench
