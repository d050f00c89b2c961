#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/markdown.h"
#include "bench/sampling.h"
#include "bench/svg_frames.h"
#include "bench/svg_plot.h"
#include "bench/techniques.h"

namespace tyndall::bench {
namespace {

struct Variant {
    std::string name;
    std::vector<std::string> settings;
    int history_frames = 0;
    int most_steps = 32;
};

/// What is compared: first nothing, then one ingredient after the other.
const std::vector<Variant>& variants() {
    using Settings = std::vector<std::string>;
    static const std::vector<Variant> list = [] {
        const auto with = [](Settings a, const Settings& b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
        };
        const Settings light{"reconstruct=light", "temporal_place=after"};
        const Settings bayer = with(light, {"noise=bayer"}), fast = with(light, {"noise=fast"});
        const Settings unfiltered{"filter=none"};
        const Settings wide{"filter=gaussian15", "filter_depth=relative"};
        const Settings narrow{"filter=gaussian1", "filter_depth=plane"};
        const Settings moving{"noise_time=golden_ratio"}, slices{"noise_time=own"};
        const Settings history{"temporal=accumulate", "temporal_clip=false"};
        return std::vector<Variant>{
            {"nothing", with(with(light, {"noise=none"}), unfiltered), 0, 256},
            {"Bayer", with(bayer, unfiltered), 0, 256},
            {"FAST", with(fast, unfiltered), 0, 128},
            {"Bayer, gaussian15", with(bayer, wide)},
            {"Bayer, gaussian15, visibility", with(with(bayer, wide), {"reconstruct=visibility"})},
            {"Bayer, gaussian1", with(bayer, narrow)},
            {"FAST, gaussian1", with(fast, narrow)},
            {"Bayer, gaussian15, half", with(with(bayer, wide), {"resolution=half"})},
            {"Bayer, history", with(with(with(bayer, moving), unfiltered), history), settled_frames, 8},
            {"FAST, history", with(with(with(fast, slices), unfiltered), history), settled_frames, 8},
            {"Bayer, gaussian1, history", with(with(with(bayer, moving), narrow), history), settled_frames, 8},
            {"Bayer, gaussian15, visibility, history",
             with(with(with(with(bayer, moving), wide), history),
                  {"reconstruct=visibility", "temporal_place=before"}),
             settled_frames, 8},
            {"Bayer, gaussian1, history, half",
             with(with(with(with(bayer, moving), narrow), history), {"resolution=half"}), settled_frames, 8},
        };
    }();
    return list;
}

const std::string standard = "Bayer, gaussian15";  ///< whose error at 8 steps is the aim
constexpr double standard_steps = 8;

/// One variant in one place over its steps.
struct Line {
    const Variant* variant;
    std::vector<glm::dvec2> errors, times;  ///< over steps
};

std::vector<Line> lines_of(const std::vector<Row>& place_rows) {
    std::vector<Line> lines;
    for (const Variant& v : variants()) {
        Line line{&v, {}, {}};
        for (const Row& row : place_rows) {
            if (row.point->configuration.family != v.name || !row.compared() || !row.timed()) continue;
            line.errors.emplace_back(row.point->value, row.measured->errors->scattering);
            line.times.emplace_back(row.point->value, row.volumetrics.least);
        }
        if (!line.errors.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

/// NaN when there is no such line.
double aim_of(const std::vector<Line>& lines) {
    for (const Line& line : lines)
        if (line.variant->name == standard) return interpolate_log(line.errors, standard_steps);
    return std::nan("");
}

}  // namespace

std::vector<Group> ingredient_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    for (const Variant& v : variants())
        for (const int steps : {1, 2, 4, 8, 16, 32, 64, 128, 256}) {
            if (steps > v.most_steps) continue;
            Point p;
            p.place = &bench::place(place.name);
            p.size = request.size;
            p.variable = "steps";
            p.value = steps;
            p.configuration.family = v.name;
            p.configuration.settings = base_settings("ray_march", v.history_frames);
            p.configuration.settings.insert(p.configuration.settings.end(), v.settings.begin(), v.settings.end());
            p.configuration.settings.push_back(fmt::format("steps={}", steps));
            p.configuration.label = std::to_string(steps);
            p.configuration.history_frames = v.history_frames;
            p.configuration.weight = 4 + steps;
            group.points.push_back(std::move(p));
        }
    return {group};
}

std::string ingredient_summary(const std::vector<Row>& rows, const std::map<std::string, std::string>& plots) {
    std::string md;
    for (const std::string& place : place_names(rows)) {
        const std::vector<Line> lines = lines_of(of_place(rows, place));
        const double aim = aim_of(lines);
        md += "## " + place + "\n\n";
        if (plots.contains(place)) md += fmt::format("![{0}](plots/{0}.svg)\n\n", place);
        std::vector<std::vector<std::string>> table{
            {"", "error at 8 steps", "ms", "steps for the aim", "ms", "steps saved", "time saved"}};
        double bare_steps = std::nan(""), bare_time = std::nan("");
        for (const Line& line : lines) {
            const double steps = first_reach(line.errors, aim);
            const double time = std::isfinite(steps) ? interpolate_log(line.times, steps) : steps;
            if (&line == &lines.front()) bare_steps = steps, bare_time = time;
            const double least = std::ranges::min_element(line.errors, {}, &glm::dvec2::y)->y;
            table.push_back(
                {line.variant->name, three(interpolate_log(line.errors, 8)), three(interpolate_log(line.times, 8)),
                 std::isfinite(steps) ? three(steps) : fmt::format("never (least {})", three(least)), three(time),
                 fmt::format("{}×", three(bare_steps / steps)), fmt::format("{}×", three(bare_time / time))});
        }
        md += markdown_table(table);
        md += fmt::format(
            "The aim is the error of `{}` at 8 steps: {}. Steps saved, time saved: against `nothing`.\n\n",
            standard, three(aim));
    }
    return md +
           "Steps and times between measured counts are interpolated in logarithms; times are the least of all "
           "frames; what accumulates is measured after 32 frames.\n";
}

std::map<std::string, std::string> ingredient_plots(const std::vector<Row>& rows, const std::string& machine) {
    std::map<std::string, std::string> pictures;
    for (const std::string& place : place_names(rows)) {
        Plot plot;
        plot.title = "What each ingredient is worth: " + place;
        plot.subtitle = machine;
        plot.x_label = "time of volumetrics (ms per frame, least)";
        plot.y_label = "relative RMSE of scattering";
        plot.notes = {"Points: 1, 2, 4 … steps"};
        for (const Line& line : lines_of(of_place(rows, place))) {
            PlotSeries series{line.variant->name,
                              legend_color(plot.series.size()),
                              static_cast<Marker>(plot.series.size() % 8),
                              {},
                              {{}}};
            for (std::size_t i = 0; i < line.errors.size(); ++i) {
                const glm::dvec2 at(line.times[i].y, line.errors[i].y);
                series.points.push_back({at, "",
                                         fmt::format("{}, {:.0f} steps: {:.3g} ms, {:.3g}", series.name,
                                                     line.errors[i].x, at.x, at.y)});
                series.curves[0].push_back(at);
            }
            plot.series.push_back(std::move(series));
        }
        if (!plot.series.empty()) pictures[place] = svg_plot(plot);
    }
    return pictures;
}

}  // namespace tyndall::bench
