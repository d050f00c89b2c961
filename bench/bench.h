#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::bench {

struct BenchOptions {
    std::string suite = "front";
    std::filesystem::path out;
    std::optional<std::filesystem::path>
        references;                   ///< folder of the ground truths; default: references, in `out`
    std::vector<std::string> places;  ///< empty: all of the suite
    std::string size = "320x180";
    std::string context = "auto";
    std::string reference = "cpu";  ///< gpu or march
    int repeats = 5;                ///< timed frames of each configuration
    bool resume = true;
    std::string command_line;  ///< for the report
};

/// Measures a suite and writes measurements.jsonl and bench.json (store.h), results.csv, results.json, summary.md
/// and plots/*.svg into `out`; the reports are written anew after each group, and on stderr goes what is being
/// done. Throws UsageError or Error.
void run_bench(const BenchOptions& options);

}  // namespace tyndall::bench
