// What a scene does not need is not done: a table of scenes and the volumetric passes each may run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/core/image.h"
#include "support/command.h"
#include "support/scenes.h"

namespace tyndall::test {
namespace {

using nlohmann::json;
using ::testing::UnorderedElementsAreArray;

const std::string global_medium =
    R"([{"shape":"global","scattering":[0.05,0.05,0.05],"absorption":[0,0,0],"anisotropy":0.3}])";
const std::string local_medium =
    R"([{"shape":"sphere","center":[0,2,0],"radius":2,"scattering":[0.5,0.5,0.5],"absorption":[0,0,0]}])";
const std::string local_medium_behind =
    R"([{"shape":"sphere","center":[0,2,40],"radius":2,"scattering":[0.5,0.5,0.5],"absorption":[0,0,0]}])";
const Lamp lamp{{0, 2, 0}, 50, 6, false};
const Lamp lamp_behind{{0, 2, 40}, 50, 6, false};

struct Frame {
    std::vector<std::string> live;
    json stats;
};

class Passes : public ::testing::Test {
  protected:
    /// With the march, where no technique is named.
    Frame draw(const SceneSpec& spec, std::vector<std::string> more = {}, const std::string& out = "out.exr") {
        write_scene(folder_ / "scene.gltf", spec);
        std::vector<std::string> arguments{
            "render",  (folder_ / "scene.gltf").string(), "-o", (folder_ / out).string(), "--size", "64x36",
            "--stats", (folder_ / "stats.json").string()};
        if (std::ranges::find(more, "--technique") == more.end())
            arguments.insert(arguments.end(), {"--technique", "ray_march"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        Frame frame;
        std::ifstream(folder_ / "stats.json") >> frame.stats;
        for (const json& pass : frame.stats["passes"])
            if (pass["live"]) frame.live.push_back(pass["name"]);
        return frame;
    }
    [[nodiscard]] static std::vector<std::string> with_prefix(const Frame& frame, const std::string& prefix) {
        std::vector<std::string> names;
        for (const std::string& name : frame.live)
            if (name.starts_with(prefix)) names.push_back(name);
        return names;
    }
    [[nodiscard]] static bool runs(const Frame& frame, const std::string& prefix) {
        return !with_prefix(frame, prefix).empty();
    }
    [[nodiscard]] Image picture(const std::string& name) const { return read_image(folder_ / name, 3); }
    TemporaryFolder folder_;
};

const std::vector<std::string> of_a_global_medium{"volumetrics/march",           "volumetrics/filter_horizontal",
                                                  "volumetrics/filter_vertical", "volumetrics/relight",
                                                  "volumetrics/temporal",        "volumetrics/composite"};

TEST_F(Passes, NoMediumIsBitIdenticalToVolumetricsOff) {
    const SceneSpec spec{.sun = true, .lamps = {lamp}};
    const Frame with = draw(spec, {"--technique", "auto"}, "with.exr");
    const Frame without = draw(spec, {"--technique", "off"}, "off.exr");
    EXPECT_EQ(with.live, without.live);
    EXPECT_FALSE(runs(with, "volumetrics/"));
    EXPECT_EQ(with.stats["memory"], without.stats["memory"]);
    EXPECT_EQ(with.stats["memory"]["volumetrics_persistent"], 0);
    EXPECT_EQ(picture("with.exr").pixels, picture("off.exr").pixels);
}

TEST_F(Passes, AutoRunsWhatEachLightNeeds) {
    const std::vector<std::string> automatic{"--technique", "auto"};
    const auto passes = [&](const SceneSpec& spec) { return with_prefix(draw(spec, automatic), "volumetrics/"); };
    const std::vector<std::string> lines{"volumetrics/epipolar_lines", "volumetrics/epipolar",
                                         "volumetrics/composite"};
    std::vector<std::string> froxels{"volumetrics/froxel_columns",
                                     "volumetrics/epipolar",
                                     "volumetrics/many_lamps_light",
                                     "volumetrics/many_lamps_history",
                                     "volumetrics/many_lamps_accumulate",
                                     "volumetrics/many_lamps",
                                     "volumetrics/lamp_cores",
                                     "volumetrics/composite"};
    EXPECT_THAT(passes({.sun = true, .media = global_medium}), UnorderedElementsAreArray(lines));
    EXPECT_THAT(passes({.lamps = {lamp, lamp, lamp}, .media = global_medium}), UnorderedElementsAreArray(lines));
    EXPECT_THAT(passes({.lamps = std::vector(30, lamp), .media = global_medium}),
                UnorderedElementsAreArray(froxels))
        << "none of them matters";
    EXPECT_THAT(passes({.lamps = {lamp_behind}, .media = global_medium}),
                UnorderedElementsAreArray({"volumetrics/epipolar", "volumetrics/composite"}));
}

TEST_F(Passes, SkippedPassesSayWhy) {
    const Frame frame = draw({.sun = true});
    bool found = false;
    for (const json& pass : frame.stats["passes"])
        if (pass["name"] == "volumetrics/march") {
            found = true;
            EXPECT_FALSE(pass["live"].get<bool>());
            EXPECT_NE(pass["reason"].get<std::string>().find("medium"), std::string::npos);
        }
    EXPECT_TRUE(found);
}

TEST_F(Passes, SunOnlyNeedsNoClustersAndNoAtlas) {
    const Frame frame = draw({.sun = true, .media = global_medium});
    EXPECT_THAT(with_prefix(frame, "volumetrics/"), UnorderedElementsAreArray(of_a_global_medium));
    EXPECT_TRUE(runs(frame, "shadow_sun"));
    for (const char* absent : {"depth_pyramid", "light_cull", "cluster", "shadow_atlas"})
        EXPECT_FALSE(runs(frame, absent)) << absent;
    EXPECT_EQ(frame.stats["work"]["volumetrics/march"]["light_evaluations"], 0) << "that is lamps";
}

TEST_F(Passes, LampOnlyNeedsNoSunShadows) {
    const Frame frame = draw({.lamps = {lamp}, .media = global_medium});
    EXPECT_THAT(with_prefix(frame, "volumetrics/"), UnorderedElementsAreArray(of_a_global_medium));
    EXPECT_FALSE(runs(frame, "shadow_sun"));
    for (const char* present : {"cluster", "shadow_atlas"}) EXPECT_TRUE(runs(frame, present)) << present;
}

TEST_F(Passes, LampBehindTheCameraCostsNothing) {
    const Frame frame = draw({.lamps = {lamp_behind}, .media = global_medium});
    for (const char* absent : {"depth_pyramid", "light_cull", "cluster", "shadow_atlas"})
        EXPECT_FALSE(runs(frame, absent)) << absent;
}

TEST_F(Passes, LocalMediumIsMarchedOnlyInView) {
    EXPECT_TRUE(runs(draw({.sun = true, .media = local_medium}), "volumetrics/march"));
    // Behind the eye it may still stand between the sun and what is seen.
    const Frame behind = draw({.sun = true, .media = local_medium_behind});
    EXPECT_THAT(with_prefix(behind, "volumetrics/"), UnorderedElementsAreArray({"volumetrics/sun_volume"}));
}

TEST_F(Passes, NoFilterNoFilterPasses) {
    const Frame frame =
        draw({.sun = true, .media = global_medium}, {"--set", "filter=none", "--set", "temporal=off"});
    EXPECT_THAT(with_prefix(frame, "volumetrics/"),
                UnorderedElementsAreArray({"volumetrics/march", "volumetrics/composite"}));
}

TEST_F(Passes, LowResolutionTakesTwoPassesAndAFourthOfTheMarch) {
    const SceneSpec spec{.sun = true, .media = global_medium};
    const Frame full = draw(spec, {"--set", "filter=none", "--set", "temporal=off"});
    const Frame half = draw(spec, {"--set", "filter=none", "--set", "temporal=off", "--set", "resolution=half"});
    EXPECT_THAT(with_prefix(half, "volumetrics/"),
                UnorderedElementsAreArray({"volumetrics/depth_downsample", "volumetrics/march",
                                           "volumetrics/upsample", "volumetrics/composite"}));
    const auto samples = [](const Frame& frame) {
        return frame.stats["work"]["volumetrics/march"]["medium_samples"].get<double>();
    };
    // Beyond the end of the march there is a sample more.
    EXPECT_NEAR(samples(half), samples(full) / 4, 0.02 * samples(full));
}

TEST_F(Passes, NoLightStillAbsorbs) {
    const Frame frame = draw({.media = global_medium});
    EXPECT_TRUE(runs(frame, "volumetrics/march"));
    EXPECT_FALSE(runs(frame, "shadow_sun"));
    EXPECT_EQ(frame.stats["work"]["volumetrics/march"].value("light_evaluations", 0), 0);
    EXPECT_EQ(frame.stats["work"]["volumetrics/march"].value("shadow_lookups", 0), 0);
}

double march_work(const Frame& frame, const std::string& kind) {
    return frame.stats["work"]["volumetrics/march"][kind].get<double>();
}
double march_evaluations(const Frame& frame) {
    return march_work(frame, "light_evaluations");
}

/// Sixteen lamps in view, the others far behind the camera.
std::vector<Lamp> lamps_of_a_big_level(int total) {
    std::vector<Lamp> lamps;
    for (int i = 0; i < 16; ++i)
        lamps.push_back(
            {{-6.0f + 0.8f * static_cast<float>(i), 1.5f, -4.0f + static_cast<float>(i % 4)}, 20, 3, false});
    for (int i = 16; i < total; ++i)
        lamps.push_back(
            {{static_cast<float>(i % 64) * 7 - 224, 2, 60 + static_cast<float>(i / 64) * 7}, 20, 3, false});
    return lamps;
}

TEST_F(Passes, MarchCostDoesNotGrowWithTheLampsOfTheLevel) {
    const Frame few = draw({.lamps = lamps_of_a_big_level(16), .media = global_medium});
    const Frame many = draw({.lamps = lamps_of_a_big_level(4096), .media = global_medium});
    EXPECT_EQ(many.stats["facts"]["local_lights_in_view"], 16);
    EXPECT_GT(march_evaluations(few), 1000);
    EXPECT_LT(march_evaluations(many), 1.05 * march_evaluations(few));
}

TEST_F(Passes, MarchCostIsLinearInStepsAndInLampsPerCluster) {
    const SceneSpec sun{.sun = true, .media = global_medium};
    const auto at_8 = draw(sun, {"--set", "steps=8"}), at_32 = draw(sun, {"--set", "steps=32"});
    // A sample more a pixel is the closed form behind the march; points outside the sun's maps need no lookup.
    EXPECT_NEAR(march_work(at_32, "medium_samples"), 4 * march_work(at_8, "medium_samples"), 3 * 64 * 36);
    EXPECT_NEAR(march_work(at_32, "shadow_lookups"), 4 * march_work(at_8, "shadow_lookups"),
                0.02 * march_work(at_32, "shadow_lookups"));

    // Lamps at one place share their clusters.
    const SceneSpec one{.lamps = {lamp}, .media = global_medium};
    const SceneSpec four{.lamps = {lamp, lamp, lamp, lamp}, .media = global_medium};
    EXPECT_EQ(march_evaluations(draw(four)), 4 * march_evaluations(draw(one)));
}

}  // namespace
}  // namespace tyndall::test
