// Writes Tyndall's sample level, or checks that a file is that level and keeps its promises.
#include <exception>
#include <iostream>

#include "tools/level/check.h"
#include "tools/modeling/files.h"
#include "tools/modeling/gltf_writer.h"

namespace {

constexpr int kRunTimeFailure = 1, kUsageError = 2;

int run(bool check, const std::string& path) {
    const auto materials = tyndall::level::make_materials();
    const auto level = tyndall::level::build_level();
    const std::string bytes = tyndall::level::to_glb(level, materials, "tyndall_level");
    if (!check) {
        if (tyndall::modeling::write_file(path, bytes)) return 0;
        std::cerr << "tyndall_level: cannot write " << path << "\n";
        return kRunTimeFailure;
    }
    const auto found = tyndall::modeling::read_file(path);
    if (!found) {
        std::cerr << "tyndall_level: cannot read " << path << "\n";
        return kRunTimeFailure;
    }
    std::string report;
    auto failures = tyndall::level::check_level(level, materials, found->size(), report);
    if (*found != bytes) failures.push_back(path + ": differs from what this program writes, write it again");
    std::cout << report;
    for (const std::string& line : failures) std::cerr << line << "\n";
    return failures.empty() ? 0 : kRunTimeFailure;
}

}  // namespace

int main(int count, char** arguments) {
    const std::string first = count > 1 ? arguments[1] : "";
    const bool check = first == "--check";
    if (count != (check ? 3 : 2) || (!check && first.starts_with("-"))) {
        std::cerr << "usage: tyndall_level OUT.glb | tyndall_level --check FILE.glb\n";
        return kUsageError;
    }
    try {
        return run(check, check ? arguments[2] : first);
    } catch (const std::exception& e) {
        std::cerr << "tyndall_level: " << e.what() << "\n";
        return kRunTimeFailure;
    }
}
