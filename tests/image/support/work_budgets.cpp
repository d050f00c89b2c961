#include "work_budgets.h"

#include <fstream>

#include "engine/scene/data_root.h"

namespace tyndall::test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const std::filesystem::path table = data_root() / "tests/image/work_budgets.json";

}  // namespace

std::vector<WorkBudget> read_work_budgets() {
    std::vector<WorkBudget> budgets;
    for (const json& row : json::parse(std::ifstream(table)))
        budgets.push_back({row.at("name"), row.at("arguments"), row.value("work", json::object())});
    return budgets;
}

void write_work_budgets(const std::vector<WorkBudget>& budgets) {
    // A line a pass, so that a change reads well.
    std::ofstream file(table);
    for (std::size_t i = 0; i < budgets.size(); ++i) {
        const WorkBudget& b = budgets[i];
        file << (i == 0 ? "[\n" : ",\n") << "  {\"name\": " << json(b.name)
             << ",\n   \"arguments\": " << json(b.arguments) << ",\n   \"work\": {";
        const char* separator = "\n";
        for (const auto& [pass, counts] : b.work.items()) {
            file << separator << "     " << json(pass) << ": " << counts;
            separator = ",\n";
        }
        file << "}}";
    }
    file << "\n]\n";
}

}  // namespace tyndall::test
