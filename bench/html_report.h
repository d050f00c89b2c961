#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall::bench {

/// One HTML page of runs of suites of points (results.json and pictures/ of each folder), which needs no network:
/// plots whose points show their picture and settings, tables that sort. The page's parts are in assets/report;
/// plots are drawn by Chart.js as Debian installs it.
/// @throws Error that names a folder without results, a file that is missing, or the package
[[nodiscard]] std::string html_report(const std::vector<std::filesystem::path>& folders);

}  // namespace tyndall::bench
