#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "bench/bench.h"
#include "session/session.h"

namespace tyndall::bench {

/// What a measurement depends on: a folder holds measurements of one such set. `scenes` are paths in the data
/// folder.
[[nodiscard]] nlohmann::json conditions_of(const BenchOptions& options, const std::set<std::string>& scenes,
                                           const Session& session);

/// The same with what a report tells besides.
[[nodiscard]] nlohmann::json told(const nlohmann::json& conditions, const BenchOptions& options);

/// For a plot's subtitle: driver, size and date.
[[nodiscard]] std::string machine_text(const nlohmann::json& conditions);

/// The head of a Markdown report: title, command, table of conditions (unfinished: rows may follow).
[[nodiscard]] std::string report_head(const std::string& title, const nlohmann::json& told);
/// Its row on the ground truth.
[[nodiscard]] std::string ground_truth_row(const nlohmann::json& told);

}  // namespace tyndall::bench
