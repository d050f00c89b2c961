#include "bench/sequence_reports.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/markdown.h"
#include "bench/sequence_tables.h"
#include "bench/svg_frames.h"

namespace tyndall::bench {
namespace {

using Names = std::vector<std::string>;

std::string quoted(const std::string& text) {
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::vector<double> values_of(const std::vector<FrameErrors>& frames, double FrameErrors::*measure) {
    std::vector<double> values;
    for (const FrameErrors& f : frames) values.push_back(f.*measure);
    return values;
}

/// The parts of a sequence's poses in which something moves.
std::vector<FramesPlot::Span> spans_of(const std::vector<Pose>& poses) {
    std::vector<FramesPlot::Span> spans;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const bool camera = poses[i].camera != poses[i - 1].camera, light = poses[i].light != poses[i - 1].light;
        if (!camera && !light) continue;
        const std::string name = camera && light ? "both" : camera ? "camera" : "lights";
        const int frame = static_cast<int>(i);
        if (!spans.empty() && spans.back().name == name && spans.back().last == frame - 1)
            spans.back().last = frame;
        else
            spans.push_back({frame - 1, frame, name});
    }
    return spans;
}

}  // namespace

std::string limit_key(const Sequence& s) {
    return fmt::format("{}-{}x{} limit", s.place->name, s.size.x, s.size.y);
}

std::string sequence_csv(const SequenceSuite& suite, const Store& store) {
    std::size_t most = 0;
    for (const Sequence& s : suite.sequences) most = std::max(most, s.poses.size());
    std::string csv = "suite,place,width,height,group,name,settings,measure";
    for (std::size_t i = 0; i < most; ++i) csv += fmt::format(",frame_{}", i);
    csv += '\n';
    for (const Sequence& s : suite.sequences) {
        const std::vector<FrameErrors>& frames = store.at(s.key()).frames;
        if (frames.empty()) continue;
        const auto line = [&](const char* measure, double FrameErrors::*member) {
            csv += fmt::format("{},{},{},{},{},{},{},{}", suite.name, s.place->name, s.size.x, s.size.y,
                               quoted(s.group), quoted(s.name), fmt::join(s.settings, " "), measure);
            for (const double v : values_of(frames, member)) csv += fmt::format(",{:.5g}", v);
            csv += std::string(most - frames.size(), ',') + '\n';
        };
        line("relative_rmse", &FrameErrors::error);
        line("relative_rmse_dim98", &FrameErrors::dim);
        line("relative_rmse_to_limit", &FrameErrors::to_limit);
    }
    return csv;
}

std::map<std::string, std::string> sequence_plots(const SequenceSuite& suite, const Store& store,
                                                  const std::string& machine) {
    std::map<std::string, FramesPlot> plots;
    std::map<std::string, std::string> colors;
    for (const Sequence& s : suite.sequences) {
        const std::vector<FrameErrors>& frames = store.at(s.key()).frames;
        if (frames.empty() || !on_plot(suite, s)) continue;
        FramesPlot& plot = plots[s.place->name];
        plot.title = fmt::format("{}: {}", suite.title, s.place->name);
        plot.subtitle = machine;
        plot.y_label = "relative RMSE of scattering";
        plot.spans = spans_of(s.poses);
        if (suite.name == "filters") plot.columns = 4;
        if (plot.panels.empty() || plot.panels.back().title != s.group) plot.panels.push_back({s.group, {}});
        if (!colors.contains(s.name)) colors.emplace(s.name, legend_color(colors.size()));
        plot.panels.back().curves.push_back({s.name, colors[s.name], values_of(frames, suite.measure)});
        const std::vector<FrameErrors>& limit = store.at(limit_key(s)).frames;
        const bool last = &s == &suite.sequences.back() || (&s)[1].group != s.group;
        if (last && !limit.empty())
            plot.panels.back().curves.push_back({"mean of 128 frames", "#1a1a1a",
                                                 std::vector<double>(frames.size(), limit.front().*suite.measure),
                                                 true});
    }
    std::map<std::string, std::string> pictures;
    for (const auto& [place, plot] : plots) pictures[place] = svg_frames(plot);
    return pictures;
}

std::string sequence_summary(const SequenceSuite& suite, const Store& store,
                             const std::map<std::string, std::string>& plots) {
    std::string md = fmt::format(
        "| drawn | {} |\n| error | relative RMSE of the scattering layer, frame by frame from no history |\n\n",
        suite.what);
    Names places;
    for (const Sequence& s : suite.sequences)
        if (std::ranges::find(places, s.place->name) == places.end()) places.push_back(s.place->name);
    for (const std::string& place : places) {
        if (!plots.contains(place)) continue;
        md += fmt::format("## {0}\n\n![{0}](plots/{0}.svg)\n\n", place);
        const auto first = std::ranges::find(suite.sequences, place,
                                             [](const Sequence& s) -> const std::string& { return s.place->name; });
        const std::vector<FrameErrors>& limit = store.at(limit_key(*first)).frames;
        if (!limit.empty())
            md += fmt::format(
                "The mean of 128 frames without history or filter has an error of {}: what is left of so few steps "
                "however many frames there are.\n\n",
                three(limit.front().*suite.measure));
        md += sequence_tables(suite, store, place);
    }
    return md;
}

}  // namespace tyndall::bench
