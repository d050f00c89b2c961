#include "sample_game/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "sample_game/bench/machine.h"
#include "sample_game/bench/reports.h"
#include "sample_game/bench/runner.h"

namespace tyndall::bench {

using nlohmann::json;

namespace {

/// What a measurement depends on: a folder holds measurements of one such set.
json conditions_of(const BenchOptions& options, const Suite& suite, const Session& session) {
    const Capabilities& driver = session.context->capabilities();
    std::set<std::string> scenes;
    for (const Group& group : suite.groups)
        for (const Point& point : group.points) scenes.insert(point.place->scene);
    Digest digest;
    for (const std::string& scene : scenes) digest.add_file(data_root() / scene);
    return {{"suite", suite.name},
            {"places", options.places},
            {"size", options.size},
            {"repeats", options.repeats},
            {"reference", options.reference},
            {"driver", driver.renderer},
            {"driver_version", driver.version},
            {"processor", processor_name()},
            {"version", program_version()},
            {"scene_files", digest.hex()},
            {"timing", session.timer_mode() == gl::TimerMode::query
                           ? "GPU timer queries"
                           : "wall clock from finish to finish of each pass (a software driver's queries lie)"}};
}

void write_reports(const BenchOptions& options, const Suite& suite, const Store& store, const json& conditions) {
    const std::vector<Row> rows = make_rows(suite, store);
    const std::string machine =
        fmt::format("{}, {}, {}", conditions["driver"].get<std::string>(), options.size, date_today());
    const std::map<std::string, std::string> plots = make_plots(suite, rows, machine);
    std::filesystem::create_directories(options.out / "plots");
    for (const auto& [name, svg] : plots) write_text(options.out / "plots" / (name + ".svg"), svg);
    json told = conditions;
    told["command"] = options.command_line;
    told["date"] = date_today();
    write_text(options.out / "results.csv", results_csv(suite, rows));
    write_text(options.out / "results.json", results_json(suite, rows, told).dump(1) + "\n");
    write_text(options.out / "summary.md", make_summary(suite, rows, told, plots));
}

}  // namespace

void run_bench(const BenchOptions& options) {
    DrawOptions size;
    size.size = options.size;
    const Suite suite = make_suite({options.suite, size.pixels(), options.places, options.reference == "gpu"});
    std::unique_ptr<Session> session = open_session(options, *suite.groups.front().points.front().place);
    const json conditions = conditions_of(options, suite, *session);
    Store store(options.out, conditions, options.resume);
    Runner(options, suite, store, session).run([&] { write_reports(options, suite, store, conditions); });
    fmt::print("{}\n", (options.out / "summary.md").string());
}

}  // namespace tyndall::bench
