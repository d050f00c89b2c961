// The benchmark's pictures and its store: what they must hold, whatever they look like.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "bench/store.h"
#include "bench/svg_plot.h"
#include "engine/core/error.h"
#include "engine/core/files.h"
#include "support/command.h"

namespace tyndall::bench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

/// Centre of the first marker of this colour.
glm::dvec2 marker_at(const std::string& svg, const std::string& color) {
    const std::regex polygon("<polygon points=\"([^\"]*)\" fill=\"" + color + "\"");
    std::smatch match;
    std::regex_search(svg, match, polygon);
    std::istringstream numbers(std::regex_replace(match[1].str(), std::regex(","), " "));
    glm::dvec2 sum(0), p;
    int count = 0;
    for (; numbers >> p.x >> p.y; ++count) sum += p;
    return sum / double(count);
}

Plot three_points() {
    Plot plot;
    plot.title = "a < b & \"c\"";
    plot.x_label = "time (ms)";
    plot.series = {{"one", "#110000", Marker::square, {{{1, 1}, "", ""}}, {}},
                   {"two", "#220000", Marker::circle, {{{10, 0.1}, "", ""}}, {}},
                   {"three", "#330000", Marker::diamond, {{{100, 0.01}, "", ""}}, {}}};
    return plot;
}

TEST(SvgPlot, EqualRatiosAreEqualDistances) {
    const std::string svg = svg_plot(three_points());
    const glm::dvec2 a = marker_at(svg, "#110000"), b = marker_at(svg, "#220000"), c = marker_at(svg, "#330000");
    EXPECT_NEAR((b - a).x, (c - b).x, 0.3);
    EXPECT_NEAR((b - a).y, (c - b).y, 0.3);
    EXPECT_GT(b.x, a.x);  // more time is to the right, less error below
    EXPECT_GT(b.y, a.y);
}

TEST(SvgPlot, TextIsEscapedAndThePageIsWhite) {
    const std::string svg = svg_plot(three_points());
    EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; &quot;c&quot;"));
    EXPECT_THAT(svg, HasSubstr("time (ms)"));
    EXPECT_THAT(svg, HasSubstr("fill=\"#ffffff\"/>"));
    EXPECT_THAT(svg, HasSubstr("three"));  // the legend
}

TEST(SvgPlot, WhatHasNoLogarithmDoesNotShow) {
    Plot plot = three_points();
    plot.series[0].points[0].at = {0, 1};
    plot.series[1].points[0].at = {1, std::nan("")};
    plot.front = {{0, 1}, {100, 0.01}};
    const std::string svg = svg_plot(plot);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    EXPECT_THAT(svg_plot(Plot{}), Not(HasSubstr("nan")));
}

TEST(Ticks, AreRoundInsideAndEnough) {
    EXPECT_THAT(log_ticks(0.9, 1100), ElementsAre(1, 10, 100, 1000));
    EXPECT_THAT(log_ticks(1.5, 6), AllOf(SizeIs(Ge(4)), ::testing::Each(AllOf(Ge(1.5), Le(6)))));
    EXPECT_THAT(log_ticks(1e-6, 1e6), SizeIs(Ge(4)));
}

TEST(Ticks, Text) {
    EXPECT_EQ(tick_text(0.0005), "0.0005");
    EXPECT_EQ(tick_text(0.02), "0.02");
    EXPECT_EQ(tick_text(1.5), "1.5");
    EXPECT_EQ(tick_text(1000), "1000");
    EXPECT_EQ(tick_text(50000), "50,000");
    EXPECT_EQ(tick_text(1e6), "10⁶");
    EXPECT_EQ(tick_text(2e-7), "2·10⁻⁷");
}

TEST(SvgBars, PartsFollowEachOther) {
    BarChart chart;
    chart.rows = {"row"};
    chart.parts = {{"a", {3.0}}, {"b", {1.0}}};
    const std::string svg = svg_bars(chart);
    const std::regex bar("<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"[^>]*><title>");
    std::vector<glm::dvec2> bars;
    for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it)
        bars.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    ASSERT_THAT(bars, SizeIs(2));
    EXPECT_NEAR(bars[0].y, 3 * bars[1].y, 0.3);
    EXPECT_NEAR(bars[0].x + bars[0].y, bars[1].x, 0.2);
}

class StoreTest : public ::testing::Test {
  protected:
    void fill() {
        Store store(folder_.path(), conditions_, true);
        store.add_time("a", {{"volumetrics/march", 2.5}, {"tonemap", 0.5}});
        store.add_errors("a", {0.25, 0.5, std::numeric_limits<double>::infinity(), 0.125, 3});
        store.add_motion("a", {0.125, {1, 0.5, 0.25}});
        store.add_work("a", {1, 2, 3, 4});
        store.add_time("b", {{"volumetrics/march", 7}});
    }
    test::TemporaryFolder folder_;
    nlohmann::json conditions_{{"size", "64x36"}, {"suite", "front"}};
};

TEST_F(StoreTest, GoesOnFromWhatWasMeasured) {
    fill();
    const Store store(folder_.path(), conditions_, true);
    const Measured& a = store.at("a");
    EXPECT_EQ(a.times, (std::vector<PassTimes>{{{"volumetrics/march", 2.5}, {"tonemap", 0.5}}}));
    ASSERT_TRUE(a.errors && a.motion && a.work);
    EXPECT_EQ(a.errors->scattering, 0.25);
    EXPECT_TRUE(std::isinf(a.errors->transmittance));
    EXPECT_EQ(a.motion->residual[2], 0.25);
    EXPECT_EQ((*a.work)[3], 4u);
    EXPECT_EQ(store.at("b").times.size(), 1u);
    EXPECT_TRUE(store.at("c").times.empty());
}

TEST_F(StoreTest, LineThatWasCutOffIsForgotten) {
    fill();
    const std::filesystem::path log = folder_ / "measurements.jsonl";
    const std::string whole = read_text(log);
    std::ofstream(log, std::ios::app) << R"({"key":"b","times":[["volum)";
    {
        Store store(folder_.path(), conditions_, true);
        EXPECT_EQ(store.at("b").times.size(), 1u);
        EXPECT_EQ(read_text(log), whole);
        store.add_time("b", {{"volumetrics/march", 8}});
    }
    EXPECT_EQ(Store(folder_.path(), conditions_, true).at("b").times.size(), 2u);
}

TEST_F(StoreTest, OtherConditionsAreAnErrorThatNamesThem) {
    fill();
    nlohmann::json other = conditions_;
    other["size"] = "320x180";
    try {
        const Store store(folder_.path(), other, true);
        FAIL() << "no error";
    } catch (const UsageError& e) {
        EXPECT_THAT(e.what(), AllOf(HasSubstr("size"), HasSubstr("64x36"), HasSubstr("320x180")));
    }
    EXPECT_TRUE(Store(folder_.path(), other, false).at("a").times.empty());
}

TEST_F(StoreTest, DamagedLineIsAnErrorWithItsNumber) {
    fill();
    std::ofstream(folder_ / "measurements.jsonl", std::ios::app) << "{\n";
    try {
        const Store store(folder_.path(), conditions_, true);
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("measurements.jsonl:6"));
    }
}

}  // namespace
}  // namespace tyndall::bench
