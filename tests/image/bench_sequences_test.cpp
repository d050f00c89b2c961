// Suites that measure frame by frame: `tyndall bench --suite sequences`, and what their reports are made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <sstream>

#include "bench/sequences.h"
#include "bench/svg_frames.h"
#include "engine/core/files.h"
#include "engine/scene/data_root.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

using ::testing::HasSubstr;

/// Cells of the lines whose measure is the relative RMSE, by group.
std::map<std::string, std::vector<std::string>> errors_by_group(const std::string& csv) {
    std::map<std::string, std::vector<std::string>> lines;
    std::istringstream in(csv);
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells;
        std::istringstream text(line + ",");
        for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
        if (cells.at(7) == "relative_rmse") lines[cells.at(4)] = {cells.begin() + 8, cells.end()};
    }
    return lines;
}

TEST(BenchSequences, EachFrameIsComparedWithTheTruthOfItsPose) {
    const TemporaryFolder folder;
    const std::vector<std::string> command{"bench", "--suite", "sequences",           "--size",
                                           "24x14", "--out",   folder.path().string()};
    const CommandResult first = run_tyndall(command);
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const std::string csv = read_text(folder / "results.csv");
    EXPECT_THAT(csv, HasSubstr("frame_4\n"));
    EXPECT_THAT(csv, Not(HasSubstr("frame_5")));
    std::map<std::string, std::vector<std::string>> errors = errors_by_group(csv);
    // Without history and with fixed noise, five pictures are one.
    ASSERT_EQ(errors["rest"].size(), 5u);
    for (const std::string& error : errors["rest"]) EXPECT_EQ(error, errors["rest"].front());
    EXPECT_GT(std::stod(errors["rest"].front()), 0.05);
    // Four poses; a truth that did not follow would be far from the picture.
    ASSERT_EQ(errors["motion"].size(), 5u);
    EXPECT_EQ(errors["motion"][4], "");
    EXPECT_EQ(errors["motion"][0], errors["rest"][0]);
    EXPECT_NE(errors["motion"][2], errors["motion"][1]);
    EXPECT_NE(errors["motion"][3], errors["motion"][2]);
    for (int frame : {2, 3})
        EXPECT_LT(std::stod(errors["motion"][std::size_t(frame)]), 1.5 * std::stod(errors["motion"][0]));
    EXPECT_THAT(read_text(folder / "plots/slats_spot.svg"), HasSubstr(">camera<"));
    EXPECT_THAT(read_text(folder / "summary.md"), HasSubstr("| rest, bayer |"));

    // Nothing is left to draw.
    const std::string log = read_text(folder / "measurements.jsonl");
    ASSERT_EQ(run_tyndall(command).exit_code, 0);
    EXPECT_EQ(read_text(folder / "measurements.jsonl"), log);
}

TEST(BenchSequences, MistakesAreOneLine) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--suite", "sequence"}, {"--suite", "noise", "--scene", "nowhere"}}) {
        std::vector<std::string> command{"bench", "--out", (folder / "a").string()};
        command.insert(command.end(), arguments.begin(), arguments.end());
        const CommandResult result = run_tyndall(command);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    }
}

TEST(BenchSequences, SamplingSuitesAskForEveryCase) {
    const auto size_of = [](const std::string& name) {
        return bench::make_sequence_suite({name, {160, 90}, {}, false}).sequences.size();
    };
    EXPECT_EQ(size_of("noise"), 3u * 8 * 4);  // places, noises, ways in time
    std::vector<bench::Pose> poses =
        bench::make_sequence_suite({"temporal", {160, 90}, {"teapot"}, false}).sequences.front().poses;
    ASSERT_EQ(poses.size(), 32u);
    EXPECT_EQ(poses[7], bench::Pose{});
    EXPECT_EQ(poses[8], (bench::Pose{1, 0}));
    EXPECT_EQ(poses[15], (bench::Pose{8, 0}));
    EXPECT_EQ(poses[16], (bench::Pose{8, 1}));
    EXPECT_EQ(poses[23], poses[31]);
}

TEST(BenchSequences, APoseMovesCameraAndLightsByAsMuchAsItSays) {
    const bench::Place& place = bench::place("slats_spot");
    Scene scene = load_gltf(data_root() / place.scene);
    const glm::ivec2 size(64, 36);
    const View rest = bench::pose(scene, place, size, {});
    const glm::mat4 lamp = scene.nodes[std::size_t(scene.lights.front().node)].world;
    const View moved = bench::pose(scene, place, size, {4, 0});
    EXPECT_NEAR(glm::distance(rest.eye, moved.eye), 0.2, 1e-5);
    // The angle between the axes along which they look: 4 × 0.5°, less where the camera looks down.
    const auto axis = [](const View& v) { return glm::vec3(glm::inverse(v.view)[2]); };
    const float level = 1 - axis(rest).y * axis(rest).y;
    const float cosine = std::cos(glm::radians(2.0f)) * level + axis(rest).y * axis(rest).y;
    EXPECT_NEAR(glm::dot(axis(rest), axis(moved)), cosine, 1e-5);
    EXPECT_EQ(scene.nodes[std::size_t(scene.lights.front().node)].world, lamp);
    (void)bench::pose(scene, place, size, {0, 4});
    const glm::mat4 there = scene.nodes[std::size_t(scene.lights.front().node)].world;
    EXPECT_NEAR(glm::distance(glm::vec3(lamp[3]), glm::vec3(there[3])), 0.2, 1e-5);
}

TEST(BenchSequences, APlotOfFramesShadesWhatMoves) {
    bench::FramesPlot plot;
    plot.panels = {{"one", {{"a", "#ff0000", {1, 0.5, 0.25}}}}, {"two", {{"a", "#ff0000", {1, 0, 0.5}}}}};
    plot.spans = {{1, 2, "camera"}};
    const std::string svg = bench::svg_frames(plot);
    for (const char* text : {"one", "two", ">camera<", "#ff0000", "</svg>"}) EXPECT_THAT(svg, HasSubstr(text));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_THAT(bench::svg_frames({}), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace tyndall::test
