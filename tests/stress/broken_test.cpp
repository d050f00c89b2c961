// A build with a guard removed is caught: the shaders are copied, one guard is cut out of the copy, and
// tyndall_stress must fail with it, as must the command that it prints.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tyndall::stress {
namespace {

namespace fs = std::filesystem;

struct Guard {
    std::string name, file;
    std::string text, without;
    std::string says;   ///< part of the line that reports it
    std::string where;  ///< the frames that meet it, for tyndall_stress
    int first = 0;
};

void PrintTo(const Guard& guard, std::ostream* out) {
    *out << guard.name;
}

struct Result {
    int exit_code;
    std::string output;
};

Result run(const std::string& command) {
    Result result{-1, ""};
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) result.output += buffer.data();
    const int status = pclose(pipe);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

class BrokenBuild : public ::testing::TestWithParam<Guard> {
  protected:
    BrokenBuild() {
        std::string pattern = (fs::temp_directory_path() / "tyndall-broken-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
        fs::copy(fs::path(TYNDALL_SOURCE_DIR) / "shaders", folder_ / "shaders", fs::copy_options::recursive);
        fs::create_directory_symlink(fs::path(TYNDALL_SOURCE_DIR) / "assets", folder_ / "assets");
    }
    ~BrokenBuild() override { fs::remove_all(folder_); }

    void remove(const Guard& guard) {
        const fs::path path = folder_ / guard.file;
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        std::string changed = text.str();
        const std::size_t at = changed.find(guard.text);
        ASSERT_NE(at, std::string::npos) << guard.file << " no longer has: " << guard.text;
        changed.replace(at, guard.text.size(), guard.without);
        std::ofstream(path) << changed;
    }
    fs::path folder_;
};

TEST_P(BrokenBuild, IsCaughtAndTheCommandRepeatsIt) {
    remove(GetParam());
    if (HasFatalFailure()) return;
    const Result found = run(fmt::format("TYNDALL_DATA={} {} {} --first {} --frames 40 --failures 1",
                                         folder_.string(), TYNDALL_STRESS, GetParam().where, GetParam().first));
    EXPECT_EQ(found.exit_code, 1) << found.output;
    EXPECT_NE(found.output.find(GetParam().says), std::string::npos) << found.output;

    const std::size_t at = found.output.find("; TYNDALL_DATA=");
    ASSERT_NE(at, std::string::npos) << found.output;
    const std::string command = found.output.substr(at + 2, found.output.find('\n', at) - at - 2);
    EXPECT_NE(command.find("--only"), std::string::npos) << command;
    const std::string data = "TYNDALL_DATA=" + folder_.string() + " ";
    ASSERT_TRUE(command.starts_with(data)) << command;
    const Result whole = run(command.substr(data.size()));
    EXPECT_EQ(whole.exit_code, 0) << "the build that is not broken fails too: " << command << "\n" << whole.output;
    const Result again = run(command);
    EXPECT_EQ(again.exit_code, 1) << command << "\n" << again.output;
    EXPECT_NE(again.output.find(GetParam().says), std::string::npos) << again.output;
}

// What keeps numbers finite and light in place.
INSTANTIATE_TEST_SUITE_P(
    Guards, BrokenBuild,
    ::testing::Values(
        Guard{"LampRadius", "shaders/lib/lamp_segment.glsl", "float sphere = max(radius, LAMP_MIN_RADIUS);",
              "float sphere = radius;", "scattering at pixel",
              "--seed 3 --where feature=extreme --where technique=ray_march --where lamp_integration=segment", 48},
        Guard{"HeightExponent", "shaders/lib/transmittance.glsl",
              "exp(min((base - y) / falloff, HEIGHT_MAX_EXPONENT))", "exp((base - y) / falloff)", "at pixel",
              "--where feature=extreme"},
        Guard{"HalfMaximum", "shaders/lib/pack.glsl", "vec4 limited = clamp(v, vec4(-HALF_MAX), vec4(HALF_MAX));",
              "vec4 limited = v;", "65504 expected", "--where feature=extreme --where technique=ray_march"},
        Guard{"Tail", "shaders/volumetrics/light/segment.glsl", "k <= TAIL_PARTS", "k < TAIL_PARTS",
              "the ground truth", "--where feature=plain --where technique=ray_march", 2048}),
    [](const auto& info) { return info.param.name; });

// Pictures that are finite, in range and wrong.
INSTANTIATE_TEST_SUITE_P(
    Physics, BrokenBuild,
    ::testing::Values(
        Guard{"PhaseSign", "shaders/lib/phase.glsl", "float signed_cos_theta = g < 0.0f ? -cos_theta : cos_theta;",
              "float signed_cos_theta = g < 0.0f ? cos_theta : -cos_theta;", "the ground truth",
              "--where feature=plain --where technique=ray_march --where phase=henyey_greenstein"},
        Guard{"LampRange", "shaders/lib/lamp_segment.glsl", "segment.weight *= max(total - cut, 0.0f)",
              "segment.weight *= total", "the ground truth", "--where feature=plain --where technique=ray_march"},
        Guard{"LocalDensity", "shaders/volumetrics/media/local_media.glsl", "float density = 1.0;",
              "float density = 0.8;", "the ground truth", "--where feature=plain --where technique=ray_march"},
        Guard{"FilterSum", "shaders/volumetrics/reconstruction/filter.frag", "            total += weight;",
              "            total += 1.1 * weight;", "filter at pixel", "--where feature=filter"},
        Guard{"LampShadow", "shaders/interface/shadows.glsl", "return light_shadow_volume(light, world);",
              "return 1.0;", "scattering with shadows",
              "--where feature=plain --where technique=ray_march --where shadows=true"},
        Guard{"UpsampleSum", "shaders/volumetrics/reconstruction/upsample.frag", "total = dot(weights, vec4(1.0));",
              "total = 1.1 * dot(weights, vec4(1.0));", "low resolution at pixel",
              "--where feature=low_resolution --where technique=ray_march"},
        Guard{"HistoryMean", "shaders/volumetrics/reconstruction/temporal.frag", "dithered_half(past + (now",
              "dithered_half(0.95 * past + (now", "history at pixel",
              "--where feature=history --where technique=ray_march"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace tyndall::stress
