// Depth edges and the error beside them, on pictures whose edges are known.
#include "engine/core/image_edges.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace tyndall {
namespace {

template <class F>
Image depth_of(glm::ivec2 size, F f) {
    Image image(size, 1);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) *image.at(x, y) = f(x, y);
    return image;
}

TEST(EdgeBand, IsThreePixelsOnEitherSideOfAStep) {
    for (const float far : {20.0f, 0.0f}) {  // a wall, the sky
        const Image band = edge_band(depth_of({20, 4}, [&](int x, int) { return x < 9 ? 5.0f : far; }), 3);
        for (int x = 0; x < 20; ++x) EXPECT_EQ(*band.at(x, 2), x >= 6 && x < 12 ? 1 : 0) << x;
    }
}

TEST(EdgeBand, FloorsWallsAndCreasesHaveNone) {
    // A floor up to a wall at 30 m: inverse depth is linear in y, then constant.
    const Image floor =
        depth_of({8, 32}, [](int, int y) { return 1 / (1 / 30.0f + 0.02f * float(std::max(y - 8, 0))); });
    for (const float v : edge_band(floor, 3).pixels) EXPECT_EQ(v, 0);
}

TEST(EdgeBand, OfAPoleOfOnePixelIsAroundIt) {
    const Image band = edge_band(depth_of({20, 1}, [](int x, int) { return x == 10 ? 5.0f : 20.0f; }), 2);
    for (int x = 0; x < 20; ++x) EXPECT_EQ(*band.at(x, 0), x >= 8 && x <= 12 ? 1 : 0) << x;
}

TEST(MaskedError, IsThatOfEachPartOverItsMean) {
    Image reference({4, 1}, 3), a({4, 1}, 3), mask({4, 1}, 1);
    for (int x = 0; x < 4; ++x)
        for (int c = 0; c < 3; ++c) {
            reference.at(x, 0)[c] = x == 0 ? 2.0f : 8.0f;
            a.at(x, 0)[c] = x == 0 ? 5.0f : 10.0f;
        }
    *mask.at(0, 0) = 1;
    const MaskedError error = masked_relative_rmse(a, reference, mask);
    EXPECT_DOUBLE_EQ(error.inside, 1.5);
    EXPECT_DOUBLE_EQ(error.outside, 0.25);
    EXPECT_DOUBLE_EQ(error.share, 0.25);
    EXPECT_DOUBLE_EQ(masked_relative_rmse(a, reference, Image({4, 1}, 1)).inside, 0);
    EXPECT_THROW((void)masked_relative_rmse(a, reference, Image({3, 1}, 1)), Error);
}

}  // namespace
}  // namespace tyndall
