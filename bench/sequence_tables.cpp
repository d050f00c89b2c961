#include "bench/sequence_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "bench/markdown.h"

namespace tyndall::bench {
namespace {

using Names = std::vector<std::string>;
using Table = std::vector<std::vector<std::string>>;

/// The sequences of one place that were measured, by group and name.
class Grid {
  public:
    Grid(const SequenceSuite& suite, const Store& store, const std::string& place) : measure_(suite.measure) {
        for (const Sequence& s : suite.sequences) {
            const std::vector<FrameErrors>& frames = store.at(s.key()).frames;
            if (s.place->name != place || frames.empty()) continue;
            add(groups, s.group);
            add(names, s.name);
            cells_[{s.group, s.name}] = &frames;
        }
    }
    Names groups, names;
    /// Null where nothing was measured.
    [[nodiscard]] const std::vector<FrameErrors>* at(const std::string& group, const std::string& name) const {
        const auto found = cells_.find({group, name});
        return found == cells_.end() ? nullptr : found->second;
    }
    /// NaN where nothing was measured.
    [[nodiscard]] double error(const std::string& group, const std::string& name, std::size_t frame) const {
        const std::vector<FrameErrors>* frames = at(group, name);
        return frames == nullptr || frame >= frames->size() ? std::numeric_limits<double>::quiet_NaN()
                                                            : (*frames)[frame].*measure_;
    }

  private:
    static void add(Names& list, const std::string& name) {
        if (std::ranges::find(list, name) == list.end()) list.push_back(name);
    }
    double FrameErrors::*measure_;
    std::map<std::pair<std::string, std::string>, const std::vector<FrameErrors>*> cells_;
};

/// Values by row and column, the least of each column in bold.
std::string least_in_bold(const std::string& corner, const Names& columns, const Names& rows,
                          const std::function<double(const std::string& row, const std::string& column)>& value) {
    Table table{{corner}};
    table[0].insert(table[0].end(), columns.begin(), columns.end());
    for (const std::string& row : rows) {
        table.push_back({row});
        for (const std::string& column : columns) {
            double least = std::numeric_limits<double>::infinity();
            for (const std::string& r : rows)
                if (value(r, column) < least) least = value(r, column);
            const double v = value(row, column);
            table.back().push_back(v == least ? fmt::format("**{}**", three(v)) : three(v));
        }
    }
    return markdown_table(table);
}

std::string noise_tables(const Grid& grid) {
    const std::string& own = grid.groups.front();
    std::string md = "Noise that changes in its own way (`noise_time=own`):\n\n";
    const Names frames{"0", "3", "11", "31"};
    md += least_in_bold("error in frame", frames, grid.names,
                        [&](const std::string& noise, const std::string& frame) {
                            return grid.error(own, noise, std::stoul(frame));
                        });
    md += "Error in frame 31 by `noise_time`:\n\n";
    md += least_in_bold("", grid.groups, grid.names, [&](const std::string& noise, const std::string& time) {
        return grid.error(time, noise, time == "fixed" ? 1 : 31);
    });
    md += "Of it, what more frames could take away (distance to the mean of 128 frames):\n\n";
    return md + least_in_bold("", grid.groups, grid.names, [&](const std::string& noise, const std::string& time) {
               const std::vector<FrameErrors>* frames_of = grid.at(time, noise);
               return frames_of == nullptr ? std::numeric_limits<double>::quiet_NaN() : frames_of->back().to_limit;
           });
}

std::string filter_tables(const Grid& grid) {
    Names filters, others;
    for (const std::string& group : grid.groups)
        (group.find(", depth ") == std::string::npos ? filters : others).push_back(group);
    std::string md;
    for (const std::size_t frame : {std::size_t(0), std::size_t(11)})
        md += fmt::format("Error in frame {}:\n\n", frame) +
              least_in_bold("", filters, grid.names, [&](const std::string& noise, const std::string& filter) {
                  return grid.error(filter, noise, frame);
              });
    md += "Noise `fast` by `filter_depth`, frame 11:\n\n";
    const Names ways{"none", "relative", "plane"};
    filters.erase(filters.begin());
    return md + least_in_bold("", filters, ways, [&](const std::string& way, const std::string& filter) {
               return grid.error(way == "relative" ? filter : filter + ", depth " + way, "fast", 11);
           });
}

/// Largest ratio to the sequence without history over some frames.
double worst(const Grid& grid, const std::string& group, const std::string& name, std::size_t first,
             std::size_t last) {
    double ratio = 0;
    for (std::size_t frame = first; frame <= last; ++frame)
        ratio = std::max(ratio, grid.error(group, name, frame) / grid.error(group, "off", frame));
    return ratio;
}

std::string temporal_tables(const Grid& grid) {
    std::string md;
    for (const std::string& group : grid.groups) {
        Table table{{group, "frame 0", "frame 4", "frame 7", "5th frame over single", "camera moves, worst",
                     "lights move, worst", "frame 31 over single"}};
        for (const std::string& name : grid.names) {
            if (grid.at(group, name) == nullptr) continue;
            const auto ratio = [&](std::size_t frame) { return worst(grid, group, name, frame, frame); };
            table.push_back({name, three(grid.error(group, name, 0)), three(grid.error(group, name, 4)),
                             three(grid.error(group, name, 7)), fmt::format("{:.2f}", ratio(4)),
                             fmt::format("{:.2f}", worst(grid, group, name, 8, 15)),
                             fmt::format("{:.2f}", worst(grid, group, name, 16, 23)),
                             fmt::format("{:.2f}", ratio(31))});
        }
        md += markdown_table(table);
    }
    return md +
           "Ratios are to `off` in the same frame: 0.25 is a quarter of its error, 1.1 is 10% worse than a single "
           "frame.\n\n";
}

/// The mean over a period of the camera, the last one.
std::string walk_tables(const Grid& grid) {
    return least_in_bold("mean of the last 32 frames", grid.names, grid.groups,
                         [&](const std::string& technique, const std::string& name) {
                             const std::vector<FrameErrors>* frames = grid.at(technique, name);
                             if (frames == nullptr) return std::numeric_limits<double>::quiet_NaN();
                             double sum = 0;
                             for (std::size_t i = frames->size() - 32; i < frames->size(); ++i)
                                 sum += (*frames)[i].error / 32;
                             return sum;
                         });
}

}  // namespace

bool on_plot(const SequenceSuite& suite, const Sequence& s) {
    if (suite.name == "noise") return s.group == "own" || s.group == "golden_ratio";
    if (suite.name == "filters") return s.group.find(", depth ") == std::string::npos;
    if (suite.name == "temporal")
        return s.name == "off" || s.name == "blend" ||
               (s.name.ends_with("reject") && s.name != "ema, clip, reject");
    return true;
}

std::string sequence_tables(const SequenceSuite& suite, const Store& store, const std::string& place) {
    const Grid grid(suite, store, place);
    if (grid.names.empty()) return "";
    if (suite.name == "noise") return noise_tables(grid);
    if (suite.name == "filters") return filter_tables(grid);
    if (suite.name == "temporal") return temporal_tables(grid);
    if (suite.name == "walk") return walk_tables(grid);
    Table table{{"", "frame 0", "last frame"}};
    for (const std::string& group : grid.groups)
        for (const std::string& name : grid.names)
            if (const std::vector<FrameErrors>* frames = grid.at(group, name))
                table.push_back({group + ", " + name, three(frames->front().error), three(frames->back().error)});
    return markdown_table(table);
}

}  // namespace tyndall::bench
