// `tyndall compare` on pictures whose errors are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/image.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

using nlohmann::json;

class CompareCommand : public ::testing::Test {
  protected:
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    void write(const std::string& name, float value, glm::ivec2 size = {20, 10}) {
        Image image(size, 3);
        std::ranges::fill(image.pixels, value);
        write_image(folder_ / name, image);
    }
    json compare(const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"compare", path(a), path(b), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return json::parse(result.out, nullptr, false);
    }
    TemporaryFolder folder_;
};

TEST_F(CompareCommand, EveryMetricByDefault) {
    write("a.exr", 3);
    write("b.exr", 2);
    const json d = compare("a.exr", "b.exr");
    EXPECT_EQ(d.size(), 6u);
    EXPECT_NEAR(d.at("rmse").get<double>(), 1, 1e-6);
    EXPECT_NEAR(d.at("relrmse").get<double>(), 0.5, 1e-6);
    EXPECT_NEAR(d.at("relmse").get<double>(), 1 / 4.01, 1e-6);
    EXPECT_NEAR(d.at("psnr").get<double>(), 20 * std::log10(2.0), 1e-6);
    EXPECT_NEAR(d.at("max").get<double>(), 1, 1e-6);
    EXPECT_GT(d.at("flip").get<double>(), 0.05);
}

TEST_F(CompareCommand, ErrorBesideDepthEdgesAndElsewhere) {
    // A step in the middle of 20 columns: 6 of them are its band. Off by 1 of 2 there, by nothing elsewhere.
    write("b.exr", 2);
    Image a({20, 10}, 3), depth({20, 10}, 1);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) {
            std::fill_n(a.at(x, y), 3, x >= 7 && x < 13 ? 3.0f : 2.0f);
            *depth.at(x, y) = x < 10 ? 5.0f : 20.0f;
        }
    write_image(folder_ / "a.exr", a);
    write_image(folder_ / "depth.exr", depth);
    const json d = compare("a.exr", "b.exr", {"--metric", "relrmse", "--edges", path("depth.exr")});
    EXPECT_NEAR(d.at("edges").get<double>(), 0.5, 1e-6);
    EXPECT_EQ(d.at("elsewhere"), 0);
    EXPECT_NEAR(d.at("edge_share").get<double>(), 0.3, 1e-6);
    write("depth.exr", 5, {3, 3});
    EXPECT_EQ(run_tyndall({"compare", path("a.exr"), path("b.exr"), "--edges", path("depth.exr")}).exit_code, 1);
}

TEST_F(CompareCommand, FlipReadsDisplayValuesOfPngAndRadianceOfExr) {
    // Black against white by the paper's formulas (tests/unit/core/flip_test.cpp).
    write("black.png", 0);
    write("white.png", 1);
    EXPECT_NEAR(compare("black.png", "white.png", {"--metric", "flip"}).at("flip").get<double>(), 0.96737, 1e-4);
    // Radiance has no white of its own: what is 40 times as bright differs in the same way at any scale:
    // B is shown at 0.85 of white, L* 93.883, A white; 0.95 (100 - 93.883)^0.7 / 16.515 = 0.2044.
    for (const float scale : {0.01f, 1.0f, 500.0f}) {
        write("a.exr", 40 * scale);
        write("b.exr", scale);
        write("c.exr", scale);
        const double flip = compare("a.exr", "b.exr", {"--metric", "flip"}).at("flip").get<double>();
        EXPECT_NEAR(flip, 0.2044, 1e-3);
        EXPECT_EQ(compare("c.exr", "b.exr", {"--metric", "flip"}).at("flip"), 0);
    }
    const CommandResult mixed = run_tyndall({"compare", path("white.png"), path("a.exr")});
    EXPECT_EQ(mixed.exit_code, 2);
    EXPECT_NE(mixed.err.find("radiance"), std::string::npos);
}

TEST_F(CompareCommand, WhatIsNotFiniteIsAnError) {
    write("b.exr", 1);
    for (const float value : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        Image image({20, 10}, 3);
        image.at(13, 4)[1] = value;
        write_image(folder_ / "bad.exr", image);
        for (const auto& [a, b] : {std::pair{"bad.exr", "b.exr"}, std::pair{"b.exr", "bad.exr"}}) {
            const CommandResult result =
                run_tyndall({"compare", path(a), path(b), "--json", "--heatmap", path("heat.png")});
            EXPECT_EQ(result.exit_code, 1);
            EXPECT_EQ(result.out, "");
            EXPECT_NE(result.err.find("bad.exr"), std::string::npos) << result.err;
            EXPECT_NE(result.err.find("(13, 4)"), std::string::npos) << result.err;
            EXPECT_FALSE(std::filesystem::exists(folder_ / "heat.png"));
        }
    }
}

TEST_F(CompareCommand, HeatmapOfFlipWhereThatAloneIsAsked) {
    Image a({60, 20}, 3), b({60, 20}, 3);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            a.at(x, y)[1] = 1;  // green against blue: the largest error
            b.at(x, y)[2] = 1;
        }
    write_image(folder_ / "a.png", a);
    write_image(folder_ / "b.png", b);
    (void)compare("a.png", "b.png", {"--metric", "flip", "--heatmap", path("flip.png")});
    const Image flip = read_image(folder_ / "flip.png", 3);
    EXPECT_NEAR(flip.at(2, 10)[0] * 255, 252, 1) << "magma's pale yellow";
    EXPECT_NEAR(flip.at(2, 10)[1] * 255, 253, 1);
    EXPECT_NEAR(flip.at(55, 10)[2] * 255, 4, 0.1) << "and its black";
    (void)compare("a.png", "b.png", {"--metric", "flip,rmse", "--heatmap", path("difference.png")});
    const Image difference = read_image(folder_ / "difference.png", 3);
    EXPECT_EQ(difference.at(55, 10)[2], 0);
    EXPECT_EQ(difference.at(2, 10)[0], 1);
}

TEST_F(CompareCommand, ThresholdPictureMarksMoreThanTenLevels) {
    Image a({3, 1}, 3), b({3, 1}, 3);
    std::ranges::fill(a.pixels, 100.0f / 255);
    std::ranges::fill(b.pixels, 100.0f / 255);
    a.at(0, 0)[0] = 110.0f / 255;
    a.at(1, 0)[2] = 111.0f / 255;
    a.at(2, 0)[1] = 89.0f / 255;
    write_image(folder_ / "a.png", a);
    write_image(folder_ / "b.png", b);
    (void)compare("a.png", "b.png", {"--threshold", path("marked.png")});
    const Image marked = read_image(folder_ / "marked.png", 3);
    EXPECT_EQ(marked.at(0, 0)[0], marked.at(0, 0)[1]);  // ten levels: not marked
    for (const int x : {1, 2}) {
        EXPECT_EQ(marked.at(x, 0)[0], 1) << x;
        EXPECT_EQ(marked.at(x, 0)[1], 0) << x;
    }
}

TEST_F(CompareCommand, ThresholdPictureOfRadianceIsInDisplayValues) {
    // White is 8. sRGB levels of 255: of 4/8 187.5; of 4.5/8 197.9; of 5/8 207.5; the first step is over ten,
    // from 4.
    Image a({200, 1}, 3), b({200, 1}, 3);
    std::ranges::fill(b.pixels, 8.0f);
    for (int c = 0; c < 3; ++c) b.at(0, 0)[c] = b.at(1, 0)[c] = 4;
    a = b;
    a.at(0, 0)[1] = 4.4f;
    a.at(1, 0)[1] = 4.6f;
    a.at(2, 0)[1] = 80;  // white is white
    write_image(folder_ / "a.exr", a);
    write_image(folder_ / "b.exr", b);
    (void)compare("a.exr", "b.exr", {"--metric", "max", "--threshold", path("marked.png")});
    const Image marked = read_image(folder_ / "marked.png", 3);
    EXPECT_NE(marked.at(0, 0)[1], 0);
    EXPECT_EQ(marked.at(1, 0)[1], 0);
    EXPECT_NE(marked.at(2, 0)[1], 0);
}

}  // namespace
}  // namespace tyndall::test
