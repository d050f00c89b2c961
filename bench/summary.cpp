#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/conditions.h"
#include "bench/markdown.h"
#include "bench/reports.h"
#include "bench/sampling.h"

namespace tyndall::bench {

using nlohmann::json;

namespace {

std::string settings_text(const Configuration& c) {
    return fmt::format("`{}`", fmt::join(c.settings, " "));
}

/// How far the times of one configuration are apart, as a rule: tells a quiet machine from a busy one.
std::string usual_spread(const std::vector<Row>& rows) {
    std::vector<double> spreads;
    for (const Row& row : rows)
        if (row.timed() && row.volumetrics.median > 0)
            spreads.push_back(row.volumetrics.spread / row.volumetrics.median);
    return spreads.empty() ? "–" : fmt::format("{:.1f}%", 100 * median_spread(spreads).median);
}

std::string method(const Suite& suite, const std::vector<Row>& rows, const json& c) {
    const auto text = [&](const char* key) { return c.value(key, json("?")).dump(); };
    std::string md = report_head(suite.title, c);
    if (suite.times)
        md += fmt::format(
            "| times | {}; median of up to {} frames in turns with all others, and interquartile range; after 5 s "
            "of timed frames two are enough |\n| spread | {} of the median, in the median of all configurations "
            "|\n",
            c.at("timing").get<std::string>(), text("repeats"), usual_spread(rows));
    if (suite.errors) md += ground_truth_row(c);
    if (suite.errors)
        md +=
            "| error | relative RMSE of the scattering layer, over pixels that see the same surface as the ground "
            "truth; dim 98%: without the 2% of pixels that are brightest there; FLIP: mean HDR FLIP of the picture "
            "|\n";
    return md + "\n";
}

std::string picture(const std::map<std::string, std::string>& plots, const std::string& name) {
    return plots.contains(name) ? fmt::format("![{0}](plots/{0}.svg)\n\n", name) : "";
}

struct Entry {
    double time, spread, error, dim, flip;
    const Configuration* configuration;
};

/// The front, and the least error within round budgets.
std::string front_tables(const std::vector<Entry>& all) {
    std::vector<Entry> entries;
    std::string md;
    for (const Entry& e : all) {
        if (!family(e.configuration->family).limit)
            entries.push_back(e);
        else
            md += fmt::format(
                "Technique `{}`: error {}, dim 98% {}, FLIP {}, {} ms. What is left is the engine's shadow "
                "maps.\n\n",
                e.configuration->family, three(e.error), three(e.dim), three(e.flip), three(e.time));
    }
    std::vector<glm::dvec2> points;
    for (const Entry& e : entries) points.emplace_back(e.time, e.error);
    const std::vector<std::size_t> front = pareto_front(points);
    md += "| time (ms) | spread | error | dim 98% | FLIP | family | settings |\n|---|---|---|---|---|---|---|\n";
    for (const std::size_t i : front) {
        const Entry& e = entries[i];
        md += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", three(e.time), three(e.spread), three(e.error),
                          three(e.dim), three(e.flip), e.configuration->family, settings_text(*e.configuration));
    }
    if (front.empty()) return md + "\n";
    md += "\n| budget (ms) | least error | family | settings |\n|---|---|---|---|\n";
    for (double decade = -2; decade < 6; ++decade)
        for (const double mantissa : {1.0, 2.0, 5.0}) {
            const double budget = mantissa * std::pow(10.0, decade);
            const Entry* best = nullptr;
            for (const std::size_t i : front)
                if (entries[i].time <= budget) best = &entries[i];
            if (best == nullptr || budget > 2.5 * entries[front.back()].time) continue;
            md += fmt::format("| {} | {} | {} | {} |\n", three(budget), three(best->error),
                              best->configuration->family, settings_text(*best->configuration));
        }
    return md + "\n";
}

std::string motion_table(const std::vector<Row>& rows) {
    std::string md;
    for (const Row& row : rows) {
        if (!row.measured->motion) continue;
        const Motion& m = *row.measured->motion;
        if (md.empty())
            md =
                "## Motion\n\nFlicker: mean change from frame to frame of a static camera over the mean, 8 frames. "
                "Lag: part of a light that shows 1, 2 and 4 frames after it was switched off. Configurations "
                "without "
                "a history are measured once for each place.\n\n"
                "| place | family | flicker | lag 1 | lag 2 | lag 4 |\n|---|---|---|---|---|---|\n";
        md += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.point->place->name,
                          row.point->configuration.family, three(m.flicker), three(m.residual[0]),
                          three(m.residual[1]), three(m.residual[2]));
    }
    return md.empty() ? md : md + "\n";
}

std::string error_time_summary(const std::vector<Row>& rows, const std::map<std::string, std::string>& plots) {
    std::string md;
    const std::vector<Mean> average = means(rows);
    if (plots.contains("overview")) {
        std::vector<Entry> entries;
        for (const Mean& m : average)
            entries.push_back({m.time, std::nan(""), m.error, m.dim, m.flip, &m.point->configuration});
        md += fmt::format("## All places\n\nGeometric means over {} places.\n\n", place_names(rows).size()) +
              picture(plots, "overview") + picture(plots, "overview_dim") + picture(plots, "overview_flip") +
              front_tables(entries);
    }
    for (const std::string& place : place_names(rows)) {
        std::vector<Entry> entries;
        double invalid = 0;
        for (const Row& row : of_place(rows, place)) {
            if (!row.timed() || !row.compared()) continue;
            entries.push_back({row.volumetrics.median, row.volumetrics.spread, row.measured->errors->scattering,
                               row.measured->errors->dim, row.measured->errors->flip, &row.point->configuration});
            invalid += row.measured->errors->invalid;
        }
        md += "## " + place + "\n\n" + picture(plots, place) + front_tables(entries);
        if (invalid > 0)
            md +=
                fmt::format("**{:.0f} values are not finite, negative, or a transmittance above 1.**\n\n", invalid);
    }
    return md + motion_table(rows);
}

std::string fit_summary(const Suite& suite, const std::vector<Row>& rows,
                        const std::map<std::string, std::string>& plots) {
    const double sign = suite.times ? 1 : -1;
    std::string md = fmt::format(
        "| place | line | over | from | to | {0} | scatter | {0}, upper half | from |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        suite.times ? "exponent" : "order");
    for (const Fitted& line : fitted_lines(suite, rows))
        md += fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {} | {:.2f} | {} |\n", line.place,
                          suite.times ? "time" : line.name, line.variable, three(line.all.first),
                          three(line.all.last), sign * line.all.exponent, three(line.all.deviation),
                          sign * line.end.exponent, three(line.end.first));
    md += "\nLeast squares in logarithms; scatter is the root mean square distance from the fit in ln.\n\n";
    for (const auto& [name, svg] : plots) md += picture(plots, name);
    return md;
}

std::string headline_summary(const std::vector<Row>& rows, const std::map<std::string, std::string>& plots) {
    std::string md =
        picture(plots, "headline") +
        "| place | error of 8 dithered | ms | undithered steps of the same error | ms | ratio of times |\n"
        "|---|---|---|---|---|---|\n";
    for (const std::string& place : place_names(rows)) {
        const Headline h = headline(of_place(rows, place));
        const std::string steps = std::isfinite(h.steps) ? fmt::format("{:.0f}", h.steps)
                                                         : fmt::format("not within {:.0f} (least error {})",
                                                                       h.most_steps, three(h.least_error));
        md += fmt::format("| {} | {} | {} | {} | {} | {} |\n", place, three(h.error), three(h.time), steps,
                          three(h.steps_time), three(h.ratio()));
    }
    return md +
           "\nDithered: Bayer 8×8 with bilateral blur. Steps and times between measured counts are interpolated "
           "in logarithms.\n";
}

std::string pass_summary(const std::vector<Row>& rows, const std::map<std::string, std::string>& plots) {
    std::vector<std::string> passes;
    for (const Row& row : rows)
        for (const auto& [pass, ms] : row.passes)
            if (std::ranges::find(passes, pass) == passes.end()) passes.push_back(pass);
    std::string md = picture(plots, "passes") + "| pass (ms) |";
    for (const Row& row : rows) md += " " + row.point->place->name + " |";
    md += "\n|---|";
    for (std::size_t i = 0; i < rows.size(); ++i) md += "---|";
    for (const std::string& pass : passes) {
        md += "\n| " + pass + " |";
        for (const Row& row : rows) {
            const auto found = std::ranges::find(row.passes, pass, &std::pair<std::string, double>::first);
            md += found == row.passes.end() ? " |" : " " + three(found->second) + " |";
        }
    }
    md += "\n| **volumetrics** |";
    for (const Row& row : rows) md += " " + three(row.volumetrics.median) + " |";
    md += "\n| **frame** |";
    for (const Row& row : rows) md += " " + three(row.frame.median) + " |";
    return md + "\n";
}

/// One value of all techniques in all places.
std::string approach_table(const std::vector<Row>& rows, const std::string& what,
                           const std::function<double(const Row&)>& value) {
    const std::vector<std::string> places = place_names(rows);
    std::vector<std::string> names;
    for (const Row& row : rows)
        if (std::ranges::count(names, row.point->configuration.family) == 0)
            names.push_back(row.point->configuration.family);
    std::string md = fmt::format("## {}\n\n| |", what);
    for (const std::string& place : places) md += " " + place + " |";
    md += "\n|---|";
    for (std::size_t i = 0; i < places.size(); ++i) md += "---|";
    for (const std::string& name : names) {
        md += "\n| " + name + " |";
        for (const std::string& place : places) {
            const std::vector<Row> here = of_place(rows, place);
            const auto row = std::ranges::find(
                here, name, [](const Row& r) -> const std::string& { return r.point->configuration.family; });
            md += row == here.end() ? " |" : " " + three(value(*row)) + " |";
        }
    }
    return md + "\n\n";
}

std::string approach_summary(const std::vector<Row>& all) {
    std::vector<Row> rows;
    std::ranges::copy_if(all, std::back_inserter(rows), [](const Row& r) { return r.timed() && r.compared(); });
    return approach_table(rows, "Error", [](const Row& r) { return r.measured->errors->scattering; }) +
           approach_table(rows, "FLIP", [](const Row& r) { return r.measured->errors->flip; }) +
           approach_table(rows, "Time of volumetrics (ms)", [](const Row& r) { return r.volumetrics.median; }) +
           motion_table(rows);
}

}  // namespace

std::string make_summary(const Suite& suite, const std::vector<Row>& rows, const json& conditions,
                         const std::map<std::string, std::string>& plots) {
    const std::string head = method(suite, rows, conditions);
    if (suite.name == "scaling" || suite.name == "convergence") return head + fit_summary(suite, rows, plots);
    if (suite.name == "headline") return head + headline_summary(rows, plots);
    if (suite.name == "approaches") return head + approach_summary(rows);
    if (suite.name == "passes") return head + pass_summary(rows, plots);
    if (suite.name == "resolution") return head + resolution_summary(rows);
    if (suite.name == "ingredients") return head + ingredient_summary(rows, plots);
    return head + error_time_summary(rows, plots);
}

}  // namespace tyndall::bench
