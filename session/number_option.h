#pragma once

#include <CLI/CLI.hpp>

namespace tyndall {

/// Checks that an option is a finite number from `low` to `high`. CLI::Range lets NaN pass, for it is neither below
/// nor above.
[[nodiscard]] CLI::Validator number_in(double low, double high);

}  // namespace tyndall
