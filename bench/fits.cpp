#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/reports.h"
#include "bench/techniques.h"

namespace tyndall::bench {
namespace {

const std::array<const char*, 6> place_colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#5b4b8a"};
constexpr std::array<Marker, 6> place_markers{Marker::circle,  Marker::square, Marker::triangle,
                                              Marker::diamond, Marker::star,   Marker::triangle_down};

void fit(Fitted& line) {
    line.all = fit_power(line.points);
    line.end = fit_power(std::span(line.points).subspan(line.points.size() / 2));
}

}  // namespace

Headline headline(const std::vector<Row>& rows) {
    Headline h;
    h.steps = h.steps_time = std::numeric_limits<double>::quiet_NaN();
    if (rows.empty() || !rows.front().compared() || rows.front().point != &rows.front().group->points.front())
        return h;
    h.error = rows.front().measured->errors->scattering;
    h.time = rows.front().volumetrics.median;
    h.least_error = std::numeric_limits<double>::infinity();
    std::vector<glm::dvec2> errors, times;
    for (const Row& row : std::span(rows).subspan(1)) {
        if (!row.compared()) continue;
        errors.emplace_back(row.point->value, row.measured->errors->scattering);
        if (row.timed()) times.emplace_back(row.point->value, row.volumetrics.median);
        h.most_steps = std::max(h.most_steps, row.point->value);
        h.least_error = std::min(h.least_error, errors.back().y);
    }
    h.steps = first_reach(errors, h.error);
    if (std::isfinite(h.steps) && !times.empty()) h.steps_time = interpolate_log(times, h.steps);
    return h;
}

std::vector<Fitted> fitted_lines(const Suite& suite, const std::vector<Row>& rows) {
    std::vector<Fitted> lines;
    const std::vector<std::string> places = place_names(rows);
    for (const Row& row : rows) {
        const Point& p = *row.point;
        if (suite.times ? !row.timed() : !row.compared()) continue;
        std::string name = p.place->name;
        if (!suite.times)
            name = p.configuration.family + (p.configuration.curve.empty() ? "" : ", " + p.configuration.curve);
        const auto same = [&](const Fitted& l) {
            return l.place == p.place->name && l.name == name && l.variable == p.variable;
        };
        auto line = std::ranges::find_if(lines, same);
        if (line == lines.end()) {
            const std::size_t index =
                static_cast<std::size_t>(std::ranges::find(places, p.place->name) - places.begin());
            Fitted fresh{
                p.place->name, name, p.variable, place_colors[index % 6], place_markers[index % 6], {}, {}, {}};
            if (!suite.times) {
                const auto before = std::size_t(std::ranges::count(lines, p.place->name, &Fitted::place));
                fresh.color = place_colors[before % 6];
                fresh.marker = place_markers[before % 6];
            }
            line = lines.insert(lines.end(), fresh);
        }
        line->points.emplace_back(p.value, suite.times ? row.volumetrics.median : row.measured->errors->scattering);
    }
    std::ranges::for_each(lines, fit);
    return lines;
}

}  // namespace tyndall::bench
