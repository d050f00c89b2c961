// Work is counted, not timed: what each technique samples, looks up and evaluates a frame. A committed table says
// how much; where a count has a closed form it is asserted apart from the table. tests/image/work_budgets.json is
// rewritten by scripts/work_budgets; a change of it is to be looked at like one of code.
#include "support/work_budgets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "engine/scene/data_root.h"
#include "support/command.h"
#include "support/scenes.h"
#include "volumetrics/settings.h"

namespace tyndall::test {
namespace {

using nlohmann::json;

json work_of(const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    std::vector<std::string> all{"render"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const std::string stats = (folder / "stats.json").string();
    for (const std::string& s : {std::string("-o"), (folder / "out.exr").string(), std::string("--stats"), stats})
        all.push_back(s);
    const CommandResult result = run_tyndall(all);
    if (result.exit_code != 0) throw std::runtime_error("tyndall render: " + result.err);
    const json counted = json::parse(std::ifstream(stats)).at("work");
    json work = json::object();
    for (const auto& [pass, counts] : counted.items())
        for (const auto& [kind, count] : counts.items())
            if (count != 0) work[pass][kind] = count;
    return work;
}

std::vector<std::string> lines_of(const std::vector<std::string>& arguments) {
    std::istringstream out(run_tyndall(arguments).out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(out, line);) lines.push_back(line);
    return lines;
}

class WorkBudgets : public ::testing::TestWithParam<WorkBudget> {};

TEST_P(WorkBudgets, AreKept) {
    const WorkBudget& row = GetParam();
    std::vector<std::string> arguments = row.arguments;
    for (std::string& a : arguments)
        if (a.starts_with("assets/") || a.starts_with("tests/")) a = (data_root() / a).string();
    const json work = work_of(arguments);
    if (std::getenv("TYNDALL_WRITE_WORK_BUDGETS") != nullptr) {
        std::vector<WorkBudget> rows = read_work_budgets();
        std::ranges::find(rows, row.name, &WorkBudget::name)->work = work;
        write_work_budgets(rows);
        return;
    }
    // What is in one of the two and not in the other counts as 0 there. Drivers round differently: 2 %.
    json either = row.work;
    either.merge_patch(work);
    for (const auto& [pass, counts] : either.items())
        for (const auto& [kind, count] : counts.items()) {
            const auto in = [&, p = pass, k = kind](const json& j) {
                return j.value(p, json::object()).value(k, 0.0);
            };
            EXPECT_NEAR(in(work), in(row.work), 0.02 * in(row.work))
                << pass << ' ' << kind << ": look why, then scripts/work_budgets";
        }
}

INSTANTIATE_TEST_SUITE_P(Table, WorkBudgets, ::testing::ValuesIn(read_work_budgets()),
                         [](const auto& info) { return info.param.name; });

TEST(WorkBudgetTable, HasEveryTechniqueAndEveryPlace) {
    std::vector<std::string> techniques, places;
    for (const WorkBudget& row : read_work_budgets()) {
        std::string technique = volumetrics::Settings{}.technique, camera;
        for (std::size_t i = 0; i + 1 < row.arguments.size(); ++i) {
            if (row.arguments[i] == "--technique") technique = row.arguments[i + 1];
            if (row.arguments[i] == "--camera") camera = row.arguments[i + 1];
        }
        techniques.push_back(technique);
        if (technique == volumetrics::Settings{}.technique) places.push_back(camera);
        EXPECT_FALSE(row.work.empty()) << row.name << ": no counts yet, run scripts/work_budgets";
    }
    for (const std::string& name : lines_of({"list", "techniques"}))
        EXPECT_TRUE(name == "off" || std::ranges::count(techniques, name) > 0)
            << name << ": add a row to tests/image/work_budgets.json";
    const std::vector<std::string> cameras = lines_of({"list", "cameras", level()});
    EXPECT_GE(cameras.size(), 6u);
    for (const std::string& camera : cameras)
        EXPECT_TRUE(camera == "flythrough" || std::ranges::count(places, camera) > 0) << camera << ": add a row";
}

constexpr int width = 64, height = 36, pixels = width * height;
const std::string thin = R"({"shape":"global","scattering":[0.01,0.01,0.01],"absorption":[0,0,0]})";
const std::string colored = R"({"shape":"global","scattering":[0.01,0.01,0.01],"absorption":[0.01,0.02,0.03]})";
const std::string opaque = R"({"shape":"global","scattering":[9,9,9],"absorption":[0,0,0]})";
const std::string everywhere =
    R"({"shape":"box","center":[0,0,0],"size":[2000,2000,2000],"scattering":[0.005,0.005,0.005],"absorption":[0,0,0]})";

/// Straight down on the floor from 10 m: every pixel shows it, and every point of air is in the sun's maps.
const std::vector<std::string> on_the_floor{"--eye", "0,10,0", "--look", "0.01,0,0"};
const std::vector<std::string> at_the_sky{"--eye", "0,10,0", "--look", "0.01,20,0"};

class ClosedWork : public ::testing::Test {
  protected:
    json march(const SceneSpec& spec, const std::vector<std::string>& view,
               std::vector<std::string> settings = {}) {
        write_scene(folder_ / "scene.gltf", spec);
        std::vector<std::string> arguments{(folder_ / "scene.gltf").string(), "--size", "64x36", "--technique",
                                           "ray_march"};
        arguments.insert(arguments.end(), view.begin(), view.end());
        for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
        return all_ = work_of(arguments), all_.value("volumetrics/march", json::object());
    }
    [[nodiscard]] double count(const std::string& pass, const std::string& kind) const {
        return all_.value(pass, json::object()).value(kind, 0.0);
    }
    static double of(const json& work, const char* kind) { return work.value(kind, 0.0); }
    json all_;
    TemporaryFolder folder_;
};

TEST_F(ClosedWork, SunIsLookedUpOnceASample) {
    const SceneSpec spec{.sun = true, .media = "[" + thin + "]"};
    for (const int steps : {8, 32}) {
        const json floor = march(spec, on_the_floor, {"steps=" + std::to_string(steps)});
        EXPECT_EQ(of(floor, "medium_samples"), pixels * steps);
        EXPECT_EQ(of(floor, "shadow_lookups"), pixels * steps);
        EXPECT_EQ(of(floor, "light_evaluations"), 0) << "lamps are meant";
        EXPECT_EQ(of(floor, "texture_fetches"), pixels) << "the depth";
    }
    const json sky = march(spec, at_the_sky);
    EXPECT_EQ(of(sky, "medium_samples"), pixels * (8 + 1)) << "and the closed form behind the march";
    EXPECT_EQ(of(sky, "shadow_lookups"), pixels * 8);
}

TEST_F(ClosedWork, EveryLampInReachIsEvaluatedOnceASample) {
    const Lamp one{{0, 5, 0}, 50, 200}, other{{1, 4, 1}, 50, 200};
    struct Case {
        std::vector<Lamp> lamps;
        const char* integration;
    };
    for (const Case& c : {Case{{one}, "segment"}, Case{{one, other}, "segment"}, Case{{one, other}, "center"}}) {
        const json work = march({.lamps = c.lamps, .media = "[" + thin + "]"}, on_the_floor,
                                {std::string("lamp_integration=") + c.integration});
        EXPECT_EQ(of(work, "medium_samples"), pixels * 8);
        EXPECT_EQ(of(work, "light_evaluations"), pixels * 8 * static_cast<double>(c.lamps.size())) << c.integration;
        EXPECT_EQ(of(work, "shadow_lookups"), of(work, "light_evaluations")) << c.integration;
    }
}

TEST_F(ClosedWork, NothingIsSampledBehindWhatIsOpaque) {
    // Optical depth 10 * 9 = 90, in equal segments; half of the smallest half float is exp(-17.3): 2 of 8 are
    // enough.
    const json work = march({.sun = true, .media = "[" + opaque + "]"}, on_the_floor, {"stepping=uniform"});
    EXPECT_EQ(of(work, "medium_samples"), pixels * 2);
    EXPECT_EQ(of(work, "shadow_lookups"), pixels * 2);
}

// A part of the ray, here a step, takes a sample of the global media and one of each local medium in it.
TEST_F(ClosedWork, LocalMediaAreSampledOnceAPartAndNoTextureHoldsThem) {
    const std::vector<std::string> settings{"light_transmittance=false", "reconstruct=light"};
    const json one = march({.sun = true, .media = "[" + everywhere + "]"}, on_the_floor, settings);
    EXPECT_EQ(of(one, "medium_samples"), pixels * 8 * (1 + 1));
    EXPECT_EQ(of(one, "texture_fetches"), pixels) << "the depth";
    EXPECT_EQ(of(one, "shadow_lookups"), pixels * 8);
    const json two =
        march({.sun = true, .media = "[" + everywhere + "," + everywhere + "]"}, on_the_floor, settings);
    EXPECT_EQ(of(two, "medium_samples"), pixels * 8 * (1 + 2));
}

TEST_F(ClosedWork, FilterAndCompositeFetchWhatTheirFiltersSay) {
    // 15 taps of scattering; bilateral: and of depth; a medium that colours light: and of transmittance. Of
    // visibility: that of the sun, whatever the medium.
    struct Case {
        const std::string& medium;
        std::vector<std::string> filter;
        int textures, composite;
    };
    for (const Case& c :
         {Case{thin, {"temporal=off", "reconstruct=light", "filter_depth=none"}, 1, 1},
          Case{thin, {"temporal=off", "reconstruct=light", "filter_depth=relative"}, 2, 1},
          Case{colored, {"temporal=off", "reconstruct=light", "filter_depth=relative"}, 3, 2},
          Case{colored, {"temporal=off", "reconstruct=visibility", "filter_depth=relative"}, 2, 2}}) {
        march({.sun = true, .media = "[" + c.medium + "]"}, on_the_floor, c.filter);
        for (const char* pass : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
            EXPECT_EQ(count(pass, "texture_fetches"), pixels * 15 * c.textures) << c.filter.back();
        EXPECT_EQ(count("volumetrics/composite", "texture_fetches"), pixels * c.composite) << c.filter.back();
    }
}

}  // namespace
}  // namespace tyndall::test
