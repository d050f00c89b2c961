// `tyndall bench` as a command, on its smallest suite.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/core/files.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Bench : public ::testing::Test {
  protected:
    CommandResult run(std::vector<std::string> more) {
        std::vector<std::string> arguments{"bench", "--size", "48x27", "--repeats", "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tyndall(arguments);
    }
    [[nodiscard]] std::string out() const { return folder_.path().string(); }
    [[nodiscard]] json results() const { return read_json(folder_ / "results.json"); }
    TemporaryFolder folder_;
};

TEST_F(Bench, SmokeSuiteWritesTablesPlotsAndGoesOn) {
    const CommandResult first = run({"--suite", "smoke", "--out", out(), "--reference", "gpu"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.out, HasSubstr("summary.md"));
    EXPECT_THAT(first.err, HasSubstr("frames to draw"));

    const json all = results();
    EXPECT_EQ(all["conditions"]["suite"], "smoke");
    for (const char* known : {"driver", "processor", "date", "version", "command", "timing"})
        EXPECT_FALSE(all["conditions"].value(known, "").empty()) << known;
    ASSERT_EQ(all["rows"].size(), 8u);  // two places, two families, two step counts
    std::map<std::string, double> march;
    for (const json& row : all["rows"]) {
        EXPECT_EQ(row["samples"], 2);
        EXPECT_GT(row["volumetrics_ms"], 0);
        EXPECT_GT(row["frame_ms"], row["volumetrics_ms"]);
        EXPECT_EQ(row["invalid_values"], 0);
        EXPECT_GT(row["scattering_relative_rmse"], 0);
        EXPECT_GT(row["medium_samples"], 0);
        double sum = 0;
        for (const auto& [pass, ms] : row["passes_ms"].items())
            if (pass.starts_with("volumetrics/")) sum += ms.get<double>();
        // Medians of sums and sums of medians of two samples are the same: both are means.
        EXPECT_NEAR(sum, row["volumetrics_ms"], 1e-6 * sum);
        march[row["settings"]] += row["medium_samples"].get<double>();
    }
    // Steps are what is counted: four times the steps, about four times the samples.
    const double few = march["technique=ray_march temporal=off noise=none filter=none reconstruct=light steps=2"];
    const double many = march["technique=ray_march temporal=off noise=none filter=none reconstruct=light steps=8"];
    EXPECT_GT(many, 2.5 * few);
    EXPECT_LT(many, 4.5 * few);

    const std::string csv = read_text(folder_ / "results.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 9);
    for (const char* plot : {"overview", "open_sun", "lamps_open"})
        EXPECT_THAT(read_text(folder_ / "plots" / (std::string(plot) + ".svg")), HasSubstr("</svg>")) << plot;
    EXPECT_THAT(read_text(folder_ / "summary.md"), HasSubstr("| budget (ms) |"));

    // One page of it, with all that it shows.
    const std::string page_path = (folder_ / "page.html").string();
    const CommandResult report = run_tyndall({"report", out(), "-o", page_path});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    const std::string page = read_text(page_path);
    for (const json& row : all["rows"])
        for (const char* kind : {"picture", "error_picture", "truth_picture"})
            EXPECT_THAT(
                page, HasSubstr(fmt::format("\"{}\":\"data:image/jpeg;base64,/9j/", row[kind].get<std::string>())));
    EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "it needs the network";
    for (const char* mark : {"/* page.css */", "/* chart.js */", "/* results */", "/* page.js */"})
        EXPECT_EQ(page.find(mark), std::string::npos) << mark << " was not filled in";

    // An interruption that cost the last three measurements: only they are made again.
    const std::filesystem::path log = folder_ / "measurements.jsonl";
    const std::string before = read_text(log);
    std::string cut = before;
    for (int i = 0; i < 3; ++i) cut.erase(cut.rfind('\n', cut.size() - 2) + 1);
    write_text(log, cut + R"({"key":")");
    const CommandResult again = run({"--suite", "smoke", "--out", out(), "--reference", "gpu"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    const std::string after = read_text(log);
    EXPECT_EQ(after.substr(0, cut.size()), cut);
    EXPECT_EQ(std::ranges::count(after, '\n'), std::ranges::count(before, '\n'));

    const CommandResult other = run({"--suite", "smoke", "--out", out(), "--reference", "cpu"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.err, HasSubstr("reference"));
}

TEST_F(Bench, ReportOfAFolderWithoutResultsFails) {
    const CommandResult none = run_tyndall({"report", out(), "-o", (folder_ / "page.html").string()});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.err, HasSubstr("results.json"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "page.html"));
    write_text(folder_ / "results.json", "{\"rows\": 3}");
    const CommandResult odd = run_tyndall({"report", out()});
    EXPECT_EQ(odd.exit_code, 1);
    EXPECT_THAT(odd.err, HasSubstr("results of a suite of points expected"));
}

TEST_F(Bench, ConvergenceOfOneSceneFallsWithSteps) {
    const CommandResult result = run({"--suite", "convergence", "--scene", "slats_sun", "--out", out()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::map<double, double> errors;
    const json all = results();
    EXPECT_EQ(all["conditions"]["reference"], "gpu");
    for (const json& row : all["rows"]) {
        EXPECT_EQ(row["samples"], 0);
        if (row["family"] == "march, undithered") errors[row["value"]] = row["scattering_relative_rmse"];
    }
    ASSERT_EQ(errors.size(), 10u);          // 1, 2, 4 … 512
    EXPECT_LT(errors[512], errors[8] / 2);  // what is left is the froxels of its local medium
    EXPECT_THAT(read_text(folder_ / "plots/slats_sun.svg"), HasSubstr("order"));
}

TEST_F(Bench, MistakesAreOneLineAndLeaveNothing) {
    const std::string file = (folder_ / "file").string();
    write_text(file, "");
    const std::vector<std::pair<std::vector<std::string>, int>> cases{
        {{"--suite", "nothing", "--out", out() + "/a"}, 2},
        {{"--suite", "smoke", "--scene", "nowhere", "--out", out() + "/a"}, 2},
        {{"--suite", "smoke"}, 2},
        {{"--suite", "smoke", "--size", "0x5", "--out", out() + "/a"}, 2},
        {{"--suite", "smoke", "--repeats", "0", "--out", out() + "/a"}, 2},
        {{"--suite", "smoke", "--reference", "tpu", "--out", out() + "/a"}, 2},
        {{"--suite", "smoke", "--out", file + "/below"}, 1}};
    for (const auto& [arguments, code] : cases) {
        const CommandResult result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << result.err;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
    }
}

}  // namespace
}  // namespace tyndall::test
