#pragma once

#include "bench/bench.h"

namespace tyndall::bench {

/// Measures a suite of sequences.h and writes the same files as run_bench(), but results.json. Throws UsageError or
/// Error.
void run_sequences(const BenchOptions& options);

}  // namespace tyndall::bench
