// The three kinds of context draw the same picture of places of the level: with most of what volumetrics has, with
// glass, water and smoke, and with the sun alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/core/image.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

constexpr double allowed_fraction = 0.001;  // of the pixels may differ by more than one 8-bit step
constexpr float one_step = 1.0f / 255.0f;

double differing_fraction(const Image& a, const Image& b) {
    EXPECT_EQ(a.size, b.size);
    std::size_t differing = 0;
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            float largest = 0;
            for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
            differing += largest > one_step * 1.01f ? 1u : 0u;
        }
    return static_cast<double>(differing) / (static_cast<double>(a.size.x) * a.size.y);
}

class Contexts : public ::testing::TestWithParam<const char*> {
  protected:
    Image draw(const std::string& context) {
        const std::filesystem::path out = folder_ / (context + ".png");
        const CommandResult result = run_tyndall({"render", level(), "-o", out.string(), "--camera", GetParam(),
                                                  "--size", "96x54", "--context", context});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_image(out, 3);
    }
    TemporaryFolder folder_;
};

TEST_P(Contexts, DrawTheSamePicture) {
    const Image egl = draw("egl");
    double mean = 0;
    for (const float v : egl.pixels) mean += v / static_cast<double>(egl.pixels.size());
    EXPECT_GT(mean, 0.02) << "the picture is black";
    EXPECT_LE(differing_fraction(egl, draw("osmesa")), allowed_fraction);
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "GLFW not compared: no DISPLAY";
    EXPECT_LE(differing_fraction(egl, draw("glfw")), allowed_fraction);
}

INSTANTIATE_TEST_SUITE_P(Places, Contexts, ::testing::Values("LocalPM", "Glass", "Sun"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tyndall::test
