// Writes the scenes of the benchmark, or checks that a folder holds them.
#include <algorithm>
#include <array>
#include <exception>
#include <iostream>

#include "tools/bench_scenes/scenes.h"
#include "tools/modeling/check.h"
#include "tools/modeling/files.h"
#include "tools/modeling/gltf_writer.h"

namespace tyndall::bench_scenes {

std::span<const Entry> all_scenes() {
    static constexpr std::array<Entry, 21> kScenes{{
        {"slats_sun", slats_sun},
        {"slats_spot", slats_spot},
        {"teapot", teapot},
        {"depths", depths},
        {"cube", cube},
        {"ragged", ragged},
        {"lamps_open", lamps_open},
        {"lamps_shadowed", lamps_shadowed},
        {"open_sun", open_sun},
        {"sky_room", sky_room},
        {"sky_court", sky_court},
        {"sky_forest", sky_forest},
        {"sky_thin_wall", sky_thin_wall},
        {"torture_posts", torture_posts},
        {"torture_slats", torture_slats},
        {"torture_lamp_at_eye", torture_lamp_at_eye},
        {"torture_lamp_behind_wall", torture_lamp_behind_wall},
        {"torture_sky", torture_sky},
        {"torture_dense", torture_dense},
        {"torture_forward", torture_forward},
        {"torture_backward", torture_backward},
    }};
    return kScenes;
}

namespace {

constexpr int kRunTimeFailure = 1, kUsageError = 2;
constexpr size_t kTriangleBudget = 20'000, kByteBudget = 400'000;

std::vector<std::string> check(const Scene& scene, const std::string& path, const std::string& bytes) {
    std::vector<std::string> failures = check_scene(scene);
    if (scene.triangles() >= kTriangleBudget)
        failures.push_back(std::to_string(scene.triangles()) + " triangles, fewer than " +
                           std::to_string(kTriangleBudget) + " allowed");
    if (bytes.size() >= kByteBudget)
        failures.push_back(std::to_string(bytes.size()) + " bytes, fewer than " + std::to_string(kByteBudget) +
                           " allowed");
    const auto found = read_file(path);
    if (!found)
        failures.emplace_back("cannot be read");
    else if (*found != bytes)
        failures.emplace_back("differs from what this program writes, write it again");
    return failures;
}

int run(bool checking, const std::string& folder) {
    const MaterialSet materials = make_materials();
    int result = 0;
    for (const Entry& entry : all_scenes()) {
        const Scene scene = entry.build();
        const std::string path = folder + "/" + entry.name + ".glb";
        const std::string bytes = to_glb(scene, materials, "tyndall_bench_scenes");
        std::vector<std::string> failures;
        if (checking)
            failures = check(scene, path, bytes);
        else if (!write_file(path, bytes))
            failures.emplace_back("cannot be written");
        for (const std::string& line : failures)
            std::cerr << "tyndall_bench_scenes: " << path << ": " << line << "\n";
        if (!failures.empty()) result = kRunTimeFailure;
    }
    return result;
}

}  // namespace

}  // namespace tyndall::bench_scenes

int main(int count, char** arguments) {
    using namespace tyndall::bench_scenes;
    const std::string first = count > 1 ? arguments[1] : "";
    const bool check = first == "--check";
    if (count != (check ? 3 : 2) || (!check && first.starts_with("-"))) {
        std::cerr << "usage: tyndall_bench_scenes DIR | tyndall_bench_scenes --check DIR\n";
        return kUsageError;
    }
    try {
        return run(check, check ? arguments[2] : first);
    } catch (const std::exception& e) {
        std::cerr << "tyndall_bench_scenes: " << e.what() << "\n";
        return kRunTimeFailure;
    }
}
