// What the commands print and write, on small scenes and pictures whose answers are known. No display needed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "engine/core/image.h"
#include "support/command.h"
#include "support/scenes.h"

namespace tyndall::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) result.push_back(line);
    return result;
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
}

/// What `tyndall list WHAT` prints.
std::vector<std::string> listed(const std::string& what) {
    const CommandResult result = run_tyndall({"list", what});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return lines(result.out);
}

TEST(List, TechniquesPresetsScenes) {
    EXPECT_THAT(listed("techniques"), IsSupersetOf({"off", "ray_march", "froxel", "reference"}));
    EXPECT_THAT(listed("presets"), IsSupersetOf({"fast"}));
    const std::vector<std::string> scenes = listed("scenes");
    EXPECT_THAT(scenes, IsSupersetOf({level()}));
    for (const std::string& scene : scenes) EXPECT_TRUE(std::filesystem::exists(scene)) << scene;
    EXPECT_EQ(run_tyndall({"list"}).exit_code, 2);
}

struct Row {
    std::string value, range, unit;
};
/// The rows of `tyndall list settings`, whose second line is help.
std::map<std::string, Row> listed_settings() {
    static const std::regex pattern(R"(^(\w+) +(\S+) *\[(.+)\] (.*)$)");
    std::map<std::string, Row> rows;
    const std::vector<std::string> text = listed("settings");
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        std::smatch m;
        EXPECT_TRUE(std::regex_match(text[i], m, pattern)) << text[i];
        EXPECT_TRUE(text[i + 1].starts_with("    ")) << text[i + 1];
        if (!m.empty()) rows[m[1]] = {m[2], m[3], m[4]};
    }
    EXPECT_EQ(rows.size(), text.size() / 2);
    return rows;
}

TEST(List, EverySettingHasARangeThatItsDefaultKeeps) {
    const std::map<std::string, Row> rows = listed_settings();
    EXPECT_GT(rows.size(), 60u);
    static const std::regex numbers(R"((\S+) … (\S+))");
    for (const auto& [key, row] : rows) {
        std::smatch m;
        if (std::regex_match(row.range, m, numbers)) {
            EXPECT_LT(std::stod(m[1]), std::stod(m[2])) << key;
            EXPECT_GE(std::stod(row.value), std::stod(m[1])) << key;
            EXPECT_LE(std::stod(row.value), std::stod(m[2])) << key;
        } else {
            EXPECT_NE((", " + row.range + ",").find(", " + row.value + ","), std::string::npos) << key;
            EXPECT_NE(row.range.find(", "), std::string::npos) << key << " leaves no choice";
        }
    }
    const auto expect_row = [&](const std::string& key, const Row& row) {
        ASSERT_TRUE(rows.contains(key)) << key;
        EXPECT_EQ(rows.at(key).value, row.value) << key;
        EXPECT_EQ(rows.at(key).range, row.range) << key;
        EXPECT_EQ(rows.at(key).unit, row.unit) << key;
    };
    expect_row("steps", {"8", "1 … 1024", ""});
    expect_row("noise_size", {"8", "2, 4, 8, 16", "px"});
    expect_row("filter_sigma", {"2", "0.3 … 7", "px"});
    expect_row("light_transmittance", {"true", "true, false", ""});
    expect_row("temporal", {"accumulate", "off, blend, ema, acceptance, accumulate", ""});
}

class Compare : public ::testing::Test {
  protected:
    Compare() {
        Image a({4, 2}, 3), b({4, 2}, 3);
        a.at(1, 1)[2] = 0.6f;  // one of 24 values differs by 0.6
        write_image(folder_ / "a.exr", a);
        write_image(folder_ / "b.exr", b);
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
    TemporaryFolder folder_;
};

TEST_F(Compare, KnownDifference) {
    const CommandResult result = run_tyndall({"compare", path("a.exr"), path("b.exr"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json d = json::parse(result.out);
    EXPECT_NEAR(d.at("rmse").get<double>(), std::sqrt(0.36 / 24), 1e-6);
    EXPECT_NEAR(d.at("relmse").get<double>(), 0.36 / 0.01 / 24, 1e-4);
    EXPECT_NEAR(d.at("max").get<double>(), 0.6, 1e-6);
}

TEST_F(Compare, OnlyTheMetricsAskedForAndAHeatmap) {
    const CommandResult result = run_tyndall(
        {"compare", path("a.exr"), path("b.exr"), "--metric", "max,rmse", "--heatmap", path("heat.png"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out).size(), 2u);
    const Image heat = read_image(path("heat.png"));
    EXPECT_EQ(heat.size, glm::ivec2(4, 2));
    EXPECT_GT(heat.at(1, 1)[0], 0.3f);
    EXPECT_EQ(heat.at(0, 0)[0], 0.0f);
}

TEST_F(Compare, IdenticalPicturesHaveInfinitePsnr) {
    const CommandResult text = run_tyndall({"compare", path("a.exr"), path("a.exr"), "--metric", "psnr"});
    EXPECT_EQ(text.out, "psnr   inf\n");
    const json d = json::parse(run_tyndall({"compare", path("a.exr"), path("a.exr"), "--json"}).out);
    EXPECT_EQ(d.at("rmse"), 0);
    EXPECT_TRUE(d.at("psnr").is_null());  // JSON has no infinity
}

TEST_F(Compare, OtherSizesAreAnError) {
    write_image(folder_ / "c.exr", Image({3, 2}, 3));
    const CommandResult result = run_tyndall({"compare", path("a.exr"), path("c.exr")});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(lines(result.err).size(), 1u);
}

class Commands : public ::testing::Test {
  protected:
    Commands() {
        write_scene(folder_ / "scene.gltf", {.sun = true,
                                             .lamps = {{{0, 2, 0}}},
                                             .media = R"([{"shape":"global","scattering":[0.05,0.05,0.05]}])"});
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
    TemporaryFolder folder_;
};

TEST_F(Commands, RenderWritesStatistics) {
    const CommandResult result =
        run_tyndall({"render", path("scene.gltf"), "-o", path("out.png"), "--size", "64x36", "--preset", "fast",
                     "--technique", "ray_march", "--set", "noise_size=4", "--stats", path("stats.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_image(path("out.png")).size, glm::ivec2(64, 36));
    const json stats = json::parse(read(path("stats.json")));
    EXPECT_EQ(stats.at("size"), json({64, 36}));
    EXPECT_EQ(stats.at("settings").at("steps"), 4);       // of the preset
    EXPECT_EQ(stats.at("settings").at("noise_size"), 4);  // --set comes after the preset
    EXPECT_EQ(stats.at("facts").at("has_sun"), true);
    EXPECT_EQ(stats.at("facts").at("has_global_medium"), true);
    EXPECT_EQ(stats.at("facts").at("has_local_media"), false);
    EXPECT_EQ(stats.at("facts").at("local_lights_in_view"), 1);
    std::set<std::string> live, skipped;
    for (const json& pass : stats.at("passes")) {
        (pass.at("live") ? live : skipped).insert(pass.at("name"));
        EXPECT_EQ(pass.at("live"), pass.value("reason", "") == "") << pass;
    }
    EXPECT_TRUE(live.contains("volumetrics/march"));
    EXPECT_TRUE(skipped.contains("volumetrics/noise_volume"));
    for (const std::string& pass : live) EXPECT_TRUE(stats.at("times_ms").contains(pass)) << pass;
    EXPECT_GT(stats.at("work").at("volumetrics/march").at("medium_samples").get<int>(), 0);
}

/// The names; all times are there, none is negative, and they sum to the total.
std::vector<std::string> startup_stages(const json& stats) {
    std::vector<std::string> names;
    double sum = 0;
    for (const json& stage : stats.at("startup").at("stages")) {
        names.push_back(stage.at("stage"));
        EXPECT_GE(stage.at("ms").get<double>(), 0) << stage;
        sum += stage.at("ms").get<double>();
    }
    EXPECT_NEAR(stats.at("startup").at("total_ms").get<double>(), sum, 1e-6);
    EXPECT_GT(sum, 1);
    return names;
}

TEST_F(Commands, StatisticsSayWhatTheTimeToTheFirstFrameWentInto) {
    using namespace std::chrono;
    const auto begin = steady_clock::now();
    const CommandResult rendered = run_tyndall({"render", path("scene.gltf"), "-o", path("out.png"), "--size",
                                                "32x18", "--frames", "3", "--stats", path("render.json")});
    const double took = duration<double, std::milli>(steady_clock::now() - begin).count();
    ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
    const json stats = json::parse(read(path("render.json")));
    EXPECT_EQ(startup_stages(stats), (std::vector<std::string>{"settings", "context", "scene", "upload", "game",
                                                               "shaders", "first frame"}));
    EXPECT_LT(stats.at("startup").at("total_ms").get<double>(), took);

    const CommandResult played = run_tyndall({"play", path("scene.gltf"), "--context", "egl", "--size", "32x18",
                                              "--frames", "2", "--stats", path("play.json")});
    ASSERT_EQ(played.exit_code, 0) << played.err;
    EXPECT_EQ(startup_stages(json::parse(read(path("play.json")))),
              (std::vector<std::string>{"settings", "context", "loading picture", "scene", "upload", "game",
                                        "shaders", "first frame"}));
}

TEST_F(Commands, AWalkThatIsNotThereIsAnErrorInALine) {
    const auto refusal = [&](const std::string& begin, int exit_code) {
        const CommandResult result =
            run_tyndall({"play", path("scene.gltf"), "--context", "egl", "--begin", begin});
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
        return result.err;
    };
    EXPECT_THAT(refusal("ending", 2), AllOf(HasSubstr("ending"), HasSubstr("title, walk or explore")));
    EXPECT_THAT(refusal("walk", 1), HasSubstr("scene.walk.json"));
    std::ofstream(folder_ / "scene.walk.json") << R"({"places": []})";
    EXPECT_THAT(refusal("title", 1), HasSubstr("\"title\" is missing"));
}

TEST_F(Commands, AFailedRenderKeepsTheOldFiles) {
    std::ofstream(folder_ / "out.png") << "old";
    const CommandResult result = run_tyndall({"render", path("scene.gltf"), "-o", path("out.png"), "--size",
                                              "32x18", "--stats", path("none/stats.json")});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
    EXPECT_EQ(read(path("out.png")), "old");
}

TEST_F(Commands, ALinkToNothingIsWrittenThrough) {
    std::filesystem::create_symlink("real.png", folder_ / "link.png");
    const CommandResult result =
        run_tyndall({"render", path("scene.gltf"), "-o", path("link.png"), "--size", "32x18"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.png"));
    EXPECT_EQ(read_image(path("real.png")).size, glm::ivec2(32, 18));
}

TEST_F(Commands, APresetOfAFileSetsWhatItNamesAndTheRestIsTheDefault) {
    std::ofstream(folder_ / "mine.json") << R"({"steps": 3, "filter": "none"})";
    const CommandResult result = run_tyndall({"render", path("scene.gltf"), "-o", path("out.png"), "--size", "16x9",
                                              "--preset", path("mine.json"), "--stats", path("stats.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json settings = json::parse(read(path("stats.json"))).at("settings");
    std::map<std::string, Row> expected = listed_settings();
    expected.at("steps").value = "3";
    expected.at("filter").value = "none";
    EXPECT_EQ(settings.size(), expected.size());
    for (const auto& [key, row] : expected) {
        const json& value = settings.at(key);
        if (value.is_number())
            EXPECT_EQ(value.get<double>(), std::stod(row.value)) << key;
        else
            EXPECT_EQ(value.is_string() ? value.get<std::string>() : value.dump(), row.value) << key;
    }
}

TEST_F(Commands, AnUnknownKeyIsRefusedByName) {
    std::ofstream(folder_ / "mine.json") << R"({"steps": 3, "stepz": 4})";
    const auto refusal = [&](const std::string& option, const std::string& value, int exit_code) {
        const CommandResult result =
            run_tyndall({"render", path("scene.gltf"), "-o", path("out.png"), "--size", "16x9", option, value});
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
        EXPECT_FALSE(std::filesystem::exists(path("out.png")));
        return result.err;
    };
    const std::string of_preset = refusal("--preset", path("mine.json"), 1);
    EXPECT_THAT(of_preset, HasSubstr("stepz"));
    EXPECT_THAT(of_preset, HasSubstr(path("mine.json")));
    EXPECT_THAT(refusal("--set", "stepz=4", 2), HasSubstr("stepz"));
}

const std::set<std::string> places{"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance"};

/// `pass` and `part`: what the technique's times are of.
void check_flythrough(const std::filesystem::path& folder, std::size_t frames, const std::string& pass,
                      const std::string& part) {
    const std::vector<std::string> rows = lines(read(folder / "frames.csv"));
    ASSERT_EQ(rows.size(), frames + 1);
    const std::vector<std::string> head = cells(rows[0]);
    ASSERT_GE(head.size(), 4u);
    EXPECT_EQ(std::vector<std::string>(head.begin(), head.begin() + 3),
              (std::vector<std::string>{"frame", "time_s", "place"}));
    EXPECT_EQ(std::count(head.begin(), head.end(), pass), 1);
    for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_TRUE(places.contains(cells(rows[i]).at(2))) << rows[i];

    const std::vector<std::string> summary = lines(read(folder / "summary.csv"));
    ASSERT_FALSE(summary.empty());
    EXPECT_EQ(summary[0], "part,frames,mean_ms,deviation_ms,variance_ms2");
    std::map<std::string, double> parts;
    for (std::size_t i = 1; i < summary.size(); ++i) {
        const std::vector<std::string> row = cells(summary[i]);
        ASSERT_EQ(row.size(), 5u);
        parts[row[0]] = std::stod(row[2]);
        EXPECT_EQ(std::stoul(row[1]), frames);
        const double deviation = std::stod(row[3]), variance = std::stod(row[4]);
        EXPECT_NEAR(deviation * deviation, variance, 1e-3 + 1e-3 * variance) << summary[i];
    }
    const auto sum = [&](const std::vector<std::string>& names) {
        double ms = 0;
        for (const std::string& name : names) ms += parts.at(name);
        return ms;
    };
    EXPECT_GT(parts.at(part), 0);
    EXPECT_GT(parts.at("Volumetrics"), 0);
    EXPECT_NEAR(
        sum({"Media injection", "Ray march", "Epipolar", "Froxels", "Filter", "Composite", "Other volumetrics"}),
        parts.at("Volumetrics"), 1e-3);
    EXPECT_NEAR(sum({"Volumetrics", "Shadows", "Surfaces", "Everything else"}), parts.at("Whole frame"), 1e-3);
    double passes = 0;  // of all frames, from the other table
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> row = cells(rows[i]);
        for (std::size_t k = 3; k < row.size(); ++k) passes += row[k].empty() ? 0 : std::stod(row[k]);
    }
    EXPECT_NEAR(passes / static_cast<double>(frames), parts.at("Whole frame"), 0.01);
    const std::string markdown = read(folder / "summary.md");
    EXPECT_NE(markdown.find("| part | frames | mean (ms) | standard deviation (ms) | variance (ms²) |"),
              std::string::npos);
    for (const std::string& place : places) {
        const Image still = read_image(folder / (place + ".png"));
        EXPECT_EQ(still.size, glm::ivec2(64, 36)) << place;
    }
}

TEST_F(Commands, FlythroughWritesTablesAndAStillOfEveryPlace) {
    const CommandResult result =
        run_tyndall({"flythrough", level(), "--out", path("fly"), "--size", "64x36", "--set",
                     "lamp_integration=center", "--duration", "1", "--frames-per-second", "2"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    check_flythrough(folder_ / "fly", 3, "volumetrics/epipolar", "Epipolar");
}

TEST_F(Commands, PlayWithoutADisplaySaysSoAndFliesThrough) {
    const CommandResult result = run_tyndall({"play", level(), "--out", path("fly"), "--size", "64x36", "--set",
                                              "lamp_integration=center", "--duration", "2"},
                                             {"DISPLAY", "WAYLAND_DISPLAY"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::vector<std::string> told = lines(result.err);
    ASSERT_FALSE(told.empty());
    EXPECT_THAT(told[0], AllOf(HasSubstr("no display"), HasSubstr(path("fly"))));
    EXPECT_THAT(told[1], HasSubstr("abbey.glb"));
    for (const std::string& place : places)
        EXPECT_EQ(std::ranges::count(told, (folder_ / "fly" / (place + ".png")).string()), 1) << result.err;
    // Without a GPU it is the preset fast.
    const bool froxels = result.err.find("preset fast") != std::string::npos;
    check_flythrough(folder_ / "fly", 3, froxels ? "volumetrics/froxel_light" : "volumetrics/epipolar",
                     froxels ? "Froxels" : "Epipolar");
}

}  // namespace
}  // namespace tyndall::test
