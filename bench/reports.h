#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/results.h"
#include "bench/techniques.h"

namespace tyndall::bench {

/// Pictures of a suite by file name without ending.
[[nodiscard]] std::map<std::string, std::string> make_plots(const Suite& suite, const std::vector<Row>& rows,
                                                            const std::string& machine);

/// Markdown: how it was measured, then the suite's tables. Refers to the plots by name.
[[nodiscard]] std::string make_summary(const Suite& suite, const std::vector<Row>& rows,
                                       const nlohmann::json& conditions,
                                       const std::map<std::string, std::string>& plots);

// What both draw from.

/// Steps that equal the first point of a headline group, and what they cost.
struct Headline {
    double error = 0, time = 0;        ///< of eight dithered steps; ms
    double steps = 0, steps_time = 0;  ///< undithered ones with the same error, interpolated; NaN: never reached
    double most_steps = 0, least_error = 0;  ///< the most that were measured, and the least error among all
    [[nodiscard]] double ratio() const { return steps_time / time; }
};
[[nodiscard]] Headline headline(const std::vector<Row>& place_rows);

/// A line of points with one power law through it.
struct Fitted {
    std::string place, name, variable;
    std::string color;
    Marker marker = Marker::circle;
    std::vector<glm::dvec2> points;
    PowerFit all;
    PowerFit end;  ///< over the upper half of the points: what it tends to
};
/// scaling: ms over the group's variable. convergence: relative RMSE over steps.
[[nodiscard]] std::vector<Fitted> fitted_lines(const Suite& suite, const std::vector<Row>& rows);

}  // namespace tyndall::bench
