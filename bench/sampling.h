#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/results.h"
#include "bench/suites.h"

// Suites that show what sampling, filters, resolution and history are worth, by settled frames; sequences.h has
// those that show them frame by frame.
namespace tyndall::bench {

/// Full, half and quarter resolution with every up-sampling and every choice of depth.
[[nodiscard]] std::vector<Group> resolution_groups(const Place& place, const PlaceFacts& facts,
                                                   const SuiteRequest& request);
[[nodiscard]] std::string resolution_summary(const std::vector<Row>& rows);

/// Ingredients that are added one after the other, each over the number of steps.
[[nodiscard]] std::vector<Group> ingredient_groups(const Place& place, const PlaceFacts& facts,
                                                   const SuiteRequest& request);
[[nodiscard]] std::string ingredient_summary(const std::vector<Row>& rows,
                                             const std::map<std::string, std::string>& plots);
[[nodiscard]] std::map<std::string, std::string> ingredient_plots(const std::vector<Row>& rows,
                                                                  const std::string& machine);

}  // namespace tyndall::bench
