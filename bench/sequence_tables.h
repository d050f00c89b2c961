#pragma once

#include <string>

#include "bench/sequences.h"
#include "bench/store.h"

namespace tyndall::bench {

/// Markdown tables of one place, as they suit the suite.
[[nodiscard]] std::string sequence_tables(const SequenceSuite& suite, const Store& store, const std::string& place);

/// Whether a sequence is drawn: a plot of all would not be read.
[[nodiscard]] bool on_plot(const SequenceSuite& suite, const Sequence& sequence);

}  // namespace tyndall::bench
