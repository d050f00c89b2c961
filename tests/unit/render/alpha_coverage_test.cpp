#include "engine/render/alpha_coverage.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tyndall {
namespace {

std::vector<std::uint8_t> texels(const std::vector<int>& alphas) {
    std::vector<std::uint8_t> rgba;
    for (const int alpha : alphas) rgba.insert(rgba.end(), {10, 20, 30, static_cast<std::uint8_t>(alpha)});
    return rgba;
}

TEST(AlphaCoverage, IsTheShareThatPasses) {
    EXPECT_EQ(alpha_coverage(texels({0, 127, 128, 255}), 0.5f), 0.5f);
    EXPECT_EQ(alpha_coverage(texels({0, 127, 128, 255}), 1.0f), 0.25f);
    EXPECT_EQ(alpha_coverage(texels({0, 1}), 0.0f), 1.0f);
    EXPECT_EQ(alpha_coverage({}, 0.5f), 0.0f);
}

TEST(AlphaCoverage, ThinAlphaIsRaisedToTheCoverageOfTheFullPicture) {
    auto rgba = texels({10, 20, 30, 40, 50, 60, 70, 80});
    scale_alpha_to_coverage(rgba, 0.5f, 0.5f);
    EXPECT_EQ(alpha_coverage(rgba, 0.5f), 0.5f);
    EXPECT_EQ(rgba[0], 10);  // colours stay
    EXPECT_EQ(rgba[2], 30);
}

TEST(AlphaCoverage, NoiseKeepsItsCoverageThroughAMipChain) {
    // A quarter of the texels are opaque; averaged 2x2 again and again, hardly any would pass a cutoff of one half.
    std::mt19937 random(1);
    std::vector<int> alpha(64 * 64);
    for (int& a : alpha) a = random() % 4 == 0 ? 255 : 0;
    const float full = alpha_coverage(texels(alpha), 0.5f);
    for (int side = 32; side >= 8; side /= 2) {
        std::vector<int> smaller(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto at = [&](int i, int k) {
                    return alpha[static_cast<std::size_t>((2 * y + k) * 2 * side + 2 * x + i)];
                };
                smaller[static_cast<std::size_t>(y * side + x)] =
                    (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4;
            }
        alpha = smaller;
        auto level = texels(alpha);
        if (side == 8) {
            EXPECT_LT(alpha_coverage(level, 0.5f), full / 2);
        }
        scale_alpha_to_coverage(level, 0.5f, full);
        EXPECT_NEAR(alpha_coverage(level, 0.5f), full, 0.15f) << side;
    }
}

TEST(AlphaCoverage, FullAndEmptyStayAsTheyAre) {
    auto full = texels({255, 255, 255}), empty = texels({0, 0, 0});
    scale_alpha_to_coverage(full, 0.5f, 1.0f);
    scale_alpha_to_coverage(empty, 0.5f, 0.0f);
    EXPECT_EQ(full, texels({255, 255, 255}));
    EXPECT_EQ(empty, texels({0, 0, 0}));
}

}  // namespace
}  // namespace tyndall
