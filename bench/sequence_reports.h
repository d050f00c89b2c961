#pragma once

#include <map>
#include <string>

#include "bench/sequences.h"
#include "bench/store.h"

namespace tyndall::bench {

/// Under which the store holds the errors of the mean of many frames at the sequence's place.
[[nodiscard]] std::string limit_key(const Sequence& sequence);

/// One line for each sequence and measure: what it is, then frame_0, frame_1 … Measures: relative_rmse,
/// relative_rmse_dim98 and relative_rmse_to_limit (0 where something moved).
[[nodiscard]] std::string sequence_csv(const SequenceSuite& suite, const Store& store);

/// Pictures by file name without ending: one for each place.
[[nodiscard]] std::map<std::string, std::string> sequence_plots(const SequenceSuite& suite, const Store& store,
                                                                const std::string& machine);

/// Markdown: rest of the table of conditions, then the suite's tables.
[[nodiscard]] std::string sequence_summary(const SequenceSuite& suite, const Store& store,
                                           const std::map<std::string, std::string>& plots);

}  // namespace tyndall::bench
