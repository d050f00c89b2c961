// What `tyndall play` takes where nothing is asked for. No display needed.
#include "sample_game/play_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* llvmpipe = "llvmpipe (LLVM 15.0.6, 256 bits)";
constexpr const char* gpu = "NVIDIA GeForce RTX 3060/PCIe/SSE2";

TEST(PlayChoice, AGpuDrawsEveryPixelWithTheDefaults) {
    const PlayChoice choice = choose_play(gpu, {});
    EXPECT_EQ(choice.window, glm::ivec2(1280, 720));
    EXPECT_EQ(choice.scale, 1);
    EXPECT_EQ(choice.frame_budget, 0);
    EXPECT_FALSE(choice.preset);
    EXPECT_EQ(choice.told, "");
}

TEST(PlayChoice, SoftwareDriversGetASmallerPictureAndAPresetAndSaySo) {
    for (const char* renderer :
         {llvmpipe, "softpipe", "SWR (LLVM 11.0, 256 bits)", "llvmpipe (LLVM 19.1.0, 128 bits)"}) {
        const PlayChoice choice = choose_play(renderer, {});
        EXPECT_EQ(choice.window, glm::ivec2(960, 540)) << renderer;
        EXPECT_LE(choice.scale, 0.5f) << renderer;
        EXPECT_EQ(choice.frame_budget, 100) << renderer;
        EXPECT_EQ(choice.preset, "fast") << renderer;
        const glm::ivec2 scene = scaled_size(choice.window, choice.scale);
        EXPECT_THAT(choice.told,
                    AllOf(HasSubstr("No GPU"), HasSubstr(std::to_string(scene.x)), HasSubstr("fast"),
                          HasSubstr("F1"), HasSubstr("--scale"), HasSubstr("--preset"), Not(HasSubstr("\n"))));
    }
}

TEST(PlayChoice, WhatWasAskedForIsDone) {
    const PlayGiven all{glm::ivec2(800, 600), 0.7f, 50.0, "quality"};
    for (const char* renderer : {llvmpipe, gpu}) {
        const PlayChoice choice = choose_play(renderer, all);
        EXPECT_EQ(choice.window, glm::ivec2(800, 600));
        EXPECT_EQ(choice.scale, 0.7f);
        EXPECT_EQ(choice.frame_budget, 50);
        EXPECT_EQ(choice.preset, "quality");
        EXPECT_EQ(choice.told, "");
    }
    // A scale that was asked for stays.
    EXPECT_EQ(choose_play(llvmpipe, {.window = {}, .scale = 0.3f, .frame_budget = {}, .preset = {}}).frame_budget,
              0);
    EXPECT_THAT(choose_play(llvmpipe, {.window = {}, .scale = 1.0f, .frame_budget = {}, .preset = {}}).told,
                AllOf(HasSubstr("preset fast"), Not(HasSubstr("pixels"))));
    EXPECT_THAT(choose_play(llvmpipe, {.window = {}, .scale = {}, .frame_budget = {}, .preset = "quality"}).told,
                AllOf(HasSubstr("pixels"), Not(HasSubstr("preset fast"))));
}

TEST(PlayChoice, TheSoftwareSceneHasTheSamePixelsInEveryWindow) {
    const PlayChoice usual = choose_play(llvmpipe, {});
    const glm::ivec2 pixels = scaled_size(usual.window, usual.scale);
    for (const glm::ivec2 window : {glm::ivec2(1280, 720), glm::ivec2(1920, 1080), glm::ivec2(640, 900)}) {
        const PlayChoice choice =
            choose_play(llvmpipe, {.window = window, .scale = {}, .frame_budget = {}, .preset = {}});
        EXPECT_EQ(choice.window, window);
        const glm::ivec2 scene = scaled_size(window, choice.scale);
        EXPECT_NEAR(scene.x * scene.y, pixels.x * pixels.y, 0.01 * pixels.x * pixels.y);
    }
    const auto scale_of = [](glm::ivec2 window) {
        return choose_play(llvmpipe, {.window = window, .scale = {}, .frame_budget = {}, .preset = {}}).scale;
    };
    EXPECT_EQ(scale_of({160, 90}), 1);
    EXPECT_EQ(scale_of({16384, 16384}), static_cast<float>(least_scale));
}

TEST(PlayChoice, APictureHasAtLeastAPixel) {
    EXPECT_EQ(scaled_size({960, 540}, 0.4f), glm::ivec2(384, 216));
    EXPECT_EQ(scaled_size({1, 3}, 0.1f), glm::ivec2(1));
}

}  // namespace
}  // namespace tyndall
