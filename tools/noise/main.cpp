// Writes the noise textures, checks that a folder holds them, or measures any texture of their kind.
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "tools/modeling/files.h"
#include "tools/noise/filters.h"
#include "tools/noise/measure.h"
#include "tools/noise/recipes.h"

namespace tyndall::noise {
namespace {

constexpr int run_time_failure = 1, usage_error = 2;
constexpr const char* usage =
    "usage: tyndall_noise DIR [NAME]…        writes all textures, or those named\n"
    "       tyndall_noise --check DIR [NAME]…  are they what would be written?\n"
    "       tyndall_noise --measure FILE…      filtered variance of 128x128x32 bytes, relative to white noise\n";

int failed(const std::string& what) {
    std::cerr << "tyndall_noise: " << what << "\n";
    return run_time_failure;
}

std::string made(const Recipe& recipe) {
    const Volume volume = generate(recipe.energies, recipe.seed, recipe_sweeps, [&](double done) {
        std::fprintf(stderr, "\r%s %3.0f%%", recipe.name.c_str(), 100 * done);
    });
    std::fprintf(stderr, "\n");
    return {volume.bytes.begin(), volume.bytes.end()};
}

int write_or_check(bool checking, const std::string& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        bool known = false;
        for (const Recipe& recipe : recipes()) known |= recipe.name == name;
        if (!known) return failed("no texture is named '" + name + "'");
    }
    int result = 0;
    for (const Recipe& recipe : recipes()) {
        bool wanted = names.empty();
        for (const std::string& name : names) wanted |= recipe.name == name;
        if (!wanted) continue;
        const std::string path = folder + "/" + recipe.file_name();
        const std::string bytes = made(recipe);
        if (!checking && !modeling::write_file(path, bytes)) result = failed(path + ": cannot be written");
        if (checking && modeling::read_file(path) != bytes)
            result = failed(path + ": differs from what this program writes, or cannot be read");
    }
    return result;
}

int measure(const std::vector<std::string>& paths) {
    std::printf("%-30s", "after the filters");
    for (const std::string& time : temporal_filter_names()) std::printf(" %9s", time.c_str());
    for (const std::string& space : spatial_filter_names()) std::printf(" %9s", space.c_str());
    std::printf(" gaussian1+ema uniform\n");
    for (const std::string& path : paths) {
        const auto bytes = modeling::read_file(path);
        if (!bytes) return failed(path + ": cannot be read");
        const Volume volume{.side = 128, .depth = 32, .bytes = {bytes->begin(), bytes->end()}};
        if (volume.bytes.size() != volume.size())
            return failed(path + ": " + std::to_string(bytes->size()) + " bytes, 524288 expected");
        std::printf("%-30.30s", path.substr(path.find_last_of('/') + 1).c_str());
        for (const std::string& time : temporal_filter_names())
            std::printf(" %9.4f", filtered_variance(volume, "", time));
        for (const std::string& space : spatial_filter_names())
            std::printf(" %9.4f", filtered_variance(volume, space, ""));
        std::printf(" %13.5f %s\n", filtered_variance(volume, "gaussian1", "ema"),
                    has_uniform_slices(volume) ? "yes" : "no");
    }
    return 0;
}

}  // namespace
}  // namespace tyndall::noise

int main(int count, char** arguments) {
    using namespace tyndall::noise;
    std::vector<std::string> words(arguments + 1, arguments + count);
    const std::string option = !words.empty() && words.front().starts_with("-") ? words.front() : "";
    if (!option.empty()) words.erase(words.begin());
    if (words.empty() || (option != "" && option != "--check" && option != "--measure")) {
        std::cerr << usage;
        return usage_error;
    }
    try {
        if (option == "--measure") return measure(words);
        const std::string folder = words.front();
        words.erase(words.begin());
        return write_or_check(option == "--check", folder, words);
    } catch (const std::exception& e) {
        return failed(e.what());
    }
}
