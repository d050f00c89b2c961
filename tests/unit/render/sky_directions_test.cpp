#include "engine/render/sky_directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall {
namespace {

constexpr int size = 32;

std::vector<glm::vec4> uniform_sky() {
    return std::vector<glm::vec4>(std::size_t{6} * size * size, glm::vec4(1, 2, 4, 1));
}

TEST(SkyDirections, PartsAreTheWholeSky) {
    for (const int count : {16, 100, 1000}) {
        const std::vector<SkyPart> parts = share_sky(uniform_sky(), size, count);
        EXPECT_EQ(std::ssize(parts), count);
        const SkyLight all = sum_of_light(parts);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(all[c].x, 1 << c, 1e-4);
            for (int i = 1; i < 4; ++i) EXPECT_NEAR(all[c][i], 0, 1e-4);
        }
        for (const SkyPart& part : parts) EXPECT_NEAR(glm::length(part.direction), 1, 1e-5);
    }
}

// Of the first half of them the light is half of all, and comes from all sides.
TEST(SkyDirections, TheFirstPartsLieAllOverTheSky) {
    const std::vector<SkyPart> parts = share_sky(uniform_sky(), size, 200);
    const SkyLight half = sum_of_light(std::span(parts).first(100));
    EXPECT_NEAR(half[0].x, 0.5, 0.05);
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(half[0][i], 0, 0.15);
}

// A spot that sends half of the light gets a third of the parts or more, and its parts lie in it.
TEST(SkyDirections, BrightLightIsManySmallParts) {
    std::vector<glm::vec4> cube = uniform_sky();
    for (int y = 12; y < 20; ++y)
        for (int x = 12; x < 20; ++x) cube[std::size_t(y * size + x)] *= 100;  // round +X
    int in_spot = 0;
    for (const SkyPart& part : share_sky(cube, size, 200)) in_spot += part.direction.x > 0.93f;
    EXPECT_GT(in_spot, 60);
}

TEST(SkyDirections, ABlackSkyHasParts) {
    const std::vector<glm::vec4> black(std::size_t{6} * size * size, glm::vec4(0));
    EXPECT_EQ(share_sky(black, size, 64).size(), 64U);
}

}  // namespace
}  // namespace tyndall
