#include <fmt/format.h>

#include <algorithm>

#include "bench/markdown.h"
#include "bench/sampling.h"
#include "bench/techniques.h"

namespace tyndall::bench {

std::vector<Group> resolution_groups(const Place& place, const PlaceFacts& facts, const SuiteRequest& request) {
    Group group{place.name, {}, facts};
    const auto add = [&](const std::string& name, const std::vector<std::string>& settings,
                         int history_frames = 0) {
        Point p;
        p.place = &bench::place(place.name);
        p.size = request.size;
        p.configuration.family = name;
        p.configuration.settings = base_settings("ray_march", history_frames);
        p.configuration.settings.insert(p.configuration.settings.end(), settings.begin(), settings.end());
        p.configuration.history_frames = history_frames;
        p.configuration.weight = 12;
        group.points.push_back(std::move(p));
    };
    add("full", {"steps=8", "resolution=full"});
    for (const char* resolution : {"half", "quarter"})
        for (const char* upsample : {"nearest", "bilinear", "bilateral", "nearest_depth"})
            for (const char* depth : {"min", "max", "checkerboard"})
                add(fmt::format("{}, {}, {}", resolution, upsample, depth),
                    {"steps=8", std::string("resolution=") + resolution, std::string("upsample=") + upsample,
                     std::string("resolution_depth=") + depth});
    // Of twice the steps: what half the resolution leaves time for.
    add("half, bilateral, checkerboard, 32 steps",
        {"steps=32", "resolution=half", "upsample=bilateral", "resolution_depth=checkerboard"});
    add("full, mean over frames", {"steps=8", "resolution=full"}, settled_frames);
    for (const char* resolution : {"half", "quarter"})
        add(std::string(resolution) + ", bilateral, checkerboard, mean over frames",
            {"steps=8", std::string("resolution=") + resolution, "upsample=bilateral",
             "resolution_depth=checkerboard"},
            settled_frames);
    return {group};
}

std::string resolution_summary(const std::vector<Row>& rows) {
    const std::vector<std::string> places = place_names(rows);
    std::vector<std::string> names, head{""};
    for (const Row& row : rows)
        if (row.compared() && std::ranges::count(names, row.point->configuration.family) == 0)
            names.push_back(row.point->configuration.family);
    head.insert(head.end(), places.begin(), places.end());
    const auto table = [&](const std::string& title, const std::function<std::string(const Row&)>& cell) {
        std::vector<std::vector<std::string>> lines{head};
        for (const std::string& name : names) {
            lines.push_back({name});
            for (const std::string& place : places) {
                const std::vector<Row> here = of_place(rows, place);
                const auto row = std::ranges::find(
                    here, name, [](const Row& r) -> const std::string& { return r.point->configuration.family; });
                lines.back().push_back(row == here.end() || !row->compared() ? "" : cell(*row));
            }
        }
        return fmt::format("## {}\n\n{}", title, markdown_table(lines));
    };
    return table("Error", [](const Row& r) { return three(r.measured->errors->scattering); }) +
           table("Error at depth edges over error elsewhere",
                 [](const Row& r) {
                     const Errors& e = *r.measured->errors;
                     return fmt::format("{} / {} = {:.2f}", three(e.edge), three(e.rest), e.edge / e.rest);
                 }) +
           "Within two pixels of where depth jumps by a tenth, and all other pixels; each over its own mean.\n\n" +
           table("Time of volumetrics (ms, least of all frames)",
                 [](const Row& r) { return three(r.volumetrics.least); });
}

}  // namespace tyndall::bench
