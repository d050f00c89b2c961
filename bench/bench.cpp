#include "bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/conditions.h"
#include "bench/reports.h"
#include "bench/runner.h"
#include "bench/sequence_runner.h"
#include "bench/sequences.h"
#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall::bench {

using nlohmann::json;

namespace {

void write_reports(const BenchOptions& options, const Suite& suite, const Store& store, const json& conditions) {
    const std::vector<Row> rows = make_rows(suite, store);
    const std::map<std::string, std::string> plots = make_plots(suite, rows, machine_text(conditions));
    std::filesystem::create_directories(options.out / "plots");
    for (const auto& [name, svg] : plots) write_text(options.out / "plots" / (name + ".svg"), svg);
    const json all = told(conditions, options);
    write_text(options.out / "results.csv", results_csv(suite, rows));
    write_text(options.out / "results.json", results_json(suite, rows, all).dump(1) + "\n");
    write_text(options.out / "summary.md", make_summary(suite, rows, all, plots));
}

}  // namespace

void run_bench(const BenchOptions& options) {
    if (std::ranges::find(sequence_suite_names(), options.suite) != sequence_suite_names().end())
        return run_sequences(options);
    DrawOptions size;
    size.size = options.size;
    const Suite suite = make_suite({options.suite, size.pixels(), options.places, options.reference == "gpu"});
    std::unique_ptr<Session> session = open_session(options, *suite.groups.front().points.front().place);
    std::set<std::string> scenes;
    for (const Group& group : suite.groups)
        for (const Point& point : group.points) scenes.insert(point.place->scene);
    const json conditions = conditions_of(options, scenes, *session);
    Store store(options.out, conditions, options.resume);
    Runner(options, suite, store, session).run([&] { write_reports(options, suite, store, conditions); });
    fmt::print("{}\n", (options.out / "summary.md").string());
}

}  // namespace tyndall::bench
