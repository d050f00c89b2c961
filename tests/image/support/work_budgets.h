#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace tyndall::test {

/// The committed table: one row a technique, scene and setting, with the arguments of `tyndall render` that draw it
/// and what its passes count. Rows are added by their `name` and `arguments`; scripts/work_budgets fills in the
/// counts.
struct WorkBudget {
    std::string name;  ///< of letters and digits
    std::vector<std::string> arguments;
    nlohmann::json work;  ///< pass -> kind -> count, without zeros
    friend void PrintTo(const WorkBudget& budget, std::ostream* out) { *out << budget.name; }
};
[[nodiscard]] std::vector<WorkBudget> read_work_budgets();
void write_work_budgets(const std::vector<WorkBudget>& budgets);

}  // namespace tyndall::test
