// The scene scaled up to the window, and the HUD that keeps the window's pixels. No display needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/core/image.h"
#include "support/command.h"
#include "support/scenes.h"

namespace tyndall::test {
namespace {

constexpr glm::ivec2 window{640, 360};

/// Whether pixels are those of text, which is white, where the HUD has its help: above its last line, whose times
/// change.
std::vector<bool> help_text(const Image& image) {
    std::vector<bool> text;
    for (int y = window.y - 85; y < window.y - 35; ++y)
        for (int x = 10; x < window.x; ++x)
            text.push_back(image.at(x, y)[0] > 0.95f && image.at(x, y)[1] > 0.95f && image.at(x, y)[2] > 0.95f);
    return text;
}

/// The sharpest edge above the HUD: the greatest difference of pixels one above the other.
float sharpest_edge(const Image& image) {
    float sharpest = 0;
    for (int y = 1; y < window.y - 100; ++y)
        for (int x = 0; x < window.x; ++x)
            sharpest = std::max(sharpest, std::abs(image.at(x, y)[1] - image.at(x, y - 1)[1]));
    return sharpest;
}

class ScaledScene : public ::testing::Test {
  protected:
    struct Played {
        Image picture;
        nlohmann::json stats;
    };
    Played play(const char* scale) {
        write_scene(folder_ / "scene.gltf", {.sun = true});
        const std::string picture = (folder_ / "picture.png").string(), stats = (folder_ / "stats.json").string();
        const CommandResult result = run_tyndall({"play",         (folder_ / "scene.gltf").string(),
                                                  "--context",    "egl",
                                                  "--size",       "640x360",
                                                  "--technique",  "off",
                                                  "--preset",     "balanced",
                                                  "--frames",     "2",
                                                  "--fixed-step", "0.1",
                                                  "--scale",      scale,
                                                  "--screenshot", picture,
                                                  "--stats",      stats});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        std::ifstream file(stats);
        return {read_image(picture), nlohmann::json::parse(file)};
    }
    TemporaryFolder folder_;
};

TEST_F(ScaledScene, IsSmootherThanTheWindowAndTheHudIsNot) {
    const Played full = play("1"), quarter = play("0.25");
    EXPECT_EQ(full.stats.at("size"), nlohmann::json({640, 360}));
    EXPECT_EQ(quarter.stats.at("size"), nlohmann::json({160, 90}));
    for (const Played* p : {&full, &quarter}) {
        EXPECT_EQ(p->stats.at("window"), nlohmann::json({640, 360}));
        ASSERT_EQ(p->picture.size, window);
        EXPECT_EQ(p->stats.at("gl_messages"), 0);
    }
    const std::vector<bool> text = help_text(full.picture);
    EXPECT_GT(std::ranges::count(text, true), 1000);
    EXPECT_EQ(text, help_text(quarter.picture));
    EXPECT_GT(sharpest_edge(full.picture), 0.2f);
    EXPECT_LT(sharpest_edge(quarter.picture), 0.6f * sharpest_edge(full.picture));
}

}  // namespace
}  // namespace tyndall::test
