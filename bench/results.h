#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/analysis.h"
#include "bench/store.h"
#include "bench/suites.h"

namespace tyndall::bench {

/// What was measured at one point, ready for tables and plots.
struct Row {
    const Group* group;
    const Point* point;
    const Measured* measured;
    MedianSpread volumetrics;  ///< ms: sum of the passes volumetrics/* of a frame; 0 when not timed
    MedianSpread frame;        ///< ms: sum of all passes
    std::vector<std::pair<std::string, double>> passes;  ///< median ms of each
    [[nodiscard]] bool timed() const { return !measured->times.empty(); }
    [[nodiscard]] bool compared() const { return measured->errors.has_value(); }
    /// ms of volumetrics and relative RMSE of scattering.
    [[nodiscard]] glm::dvec2 cost_and_error() const {
        return {volumetrics.median, compared() ? measured->errors->scattering : 0};
    }
};
/// Of all points of which something is known, in the suite's order. Suite and store must outlive them.
[[nodiscard]] std::vector<Row> make_rows(const Suite& suite, const Store& store);

/// Names of places or groups, each once, in order.
[[nodiscard]] std::vector<std::string> place_names(const std::vector<Row>& rows);
[[nodiscard]] std::vector<Row> of_place(const std::vector<Row>& rows, const std::string& place);

/// A configuration over all places: geometric means of time, errors of scattering and FLIP. Where a place has no
/// lamps, all rules for lamps are one and the same. Configurations that some place lacks are left out.
struct Mean {
    const Point* point;  ///< of one place, for the configuration
    double time = 0, error = 0, dim = 0, flip = 0;
};
[[nodiscard]] std::vector<Mean> means(const std::vector<Row>& rows);

[[nodiscard]] std::string results_csv(const Suite& suite, const std::vector<Row>& rows);
[[nodiscard]] nlohmann::json results_json(const Suite& suite, const std::vector<Row>& rows,
                                          const nlohmann::json& conditions);

}  // namespace tyndall::bench
