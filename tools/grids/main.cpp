// Writes the density grids of assets/grids, or checks that a folder holds them.
#include <exception>
#include <iostream>
#include <string>

#include "tools/grids/models.h"
#include "tools/grids/nanovdb_writer.h"
#include "tools/modeling/files.h"

namespace {

using namespace tyndall;

constexpr int run_time_failure = 1, usage_error = 2;

struct Model {
    std::string file;
    grid_models::Voxels (*make)();
};
const Model models[] = {{"cumulus.nvdb", grid_models::make_cumulus}, {"smoke.nvdb", grid_models::make_smoke}};

int run(bool checking, const std::string& folder) {
    int result = 0;
    for (const Model& model : models) {
        const std::string path = folder + "/" + model.file, bytes = grid_models::to_nanovdb(model.make());
        std::string failure;
        if (!checking && !modeling::write_file(path, bytes)) failure = "cannot be written";
        if (checking && modeling::read_file(path) != bytes)
            failure = "differs from what this program writes, or cannot be read";
        if (failure.empty()) continue;
        std::cerr << "tyndall_grid_models: " << path << ": " << failure << "\n";
        result = run_time_failure;
    }
    return result;
}

}  // namespace

int main(int count, char** arguments) {
    const std::string first = count > 1 ? arguments[1] : "";
    const bool checking = first == "--check";
    if (count != (checking ? 3 : 2) || (!checking && first.starts_with("-"))) {
        std::cerr << "usage: tyndall_grid_models DIR | tyndall_grid_models --check DIR\n";
        return usage_error;
    }
    try {
        return run(checking, checking ? arguments[2] : first);
    } catch (const std::exception& e) {
        std::cerr << "tyndall_grid_models: " << e.what() << "\n";
        return run_time_failure;
    }
}
