#pragma once

#include <CLI/CLI.hpp>

namespace tyndall {

/// Each adds one subcommand with its options; the subcommand runs from CLI's final callback and throws UsageError
/// (exit code 2) or Error (1).
void add_bench_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_flythrough_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_list_command(CLI::App& app);
void add_play_command(CLI::App& app);
void add_reference_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_report_command(CLI::App& app);

}  // namespace tyndall
