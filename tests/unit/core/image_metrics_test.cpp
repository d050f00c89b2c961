#include "engine/core/image_metrics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"

namespace tyndall {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::Pointwise;
using testing::ThrowsMessage;

Image picture(std::vector<float> values, int channels = 3) {
    Image image({static_cast<int>(values.size()) / channels, 1}, channels);
    image.pixels = std::move(values);
    return image;
}

TEST(PictureMetrics, MeanLeavesAlphaOut) {
    EXPECT_DOUBLE_EQ(mean_value(picture({1, 2, 3, 100, 4, 5, 6, 100}, 4)), 3.5);
    EXPECT_DOUBLE_EQ(mean_value(picture({1, 3}, 1)), 2);
    EXPECT_DOUBLE_EQ(mean_value(Image()), 0);
}

TEST(PictureMetrics, RelativeRmseIsOverTheMeanOfTheReference) {
    // Differences 1, -1, 2, 0, 0, 0: rmse 1; the reference's mean is 24 / 6.
    const Image reference = picture({2, 2, 2, 6, 6, 6});
    EXPECT_NEAR(relative_rmse(picture({3, 1, 4, 6, 6, 6}), reference), 0.25, 1e-12);
    const Image black = picture({0, 0, 0});
    EXPECT_EQ(relative_rmse(picture({0, 1, 0}), black), std::numeric_limits<double>::infinity());
    EXPECT_EQ(relative_rmse(black, black), 0);
}

TEST(PictureMetrics, ThresholdPictureMarksWhatDiffersByMore) {
    const Image reference = picture({0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 1, 0.25f, 0});
    const Image a = picture({0.5f, 0.5f, 0.75f, 0.5f, 0.375f, 0.5f, 1, 0.25f, 0});
    EXPECT_THAT(threshold_picture(a, reference, 0.125f).pixels,
                ElementsAre(1, 0, 0, 0.25f, 0.25f, 0.25f, 0.5f, 0.125f, 0));
    EXPECT_THAT(threshold_picture(a, reference, 0.124f).pixels, ElementsAre(1, 0, 0, 1, 0, 0, 0.5f, 0.125f, 0));
    EXPECT_THROW((void)threshold_picture(a, picture({0, 0, 0}), 0.1f), Error);
}

TEST(PictureMetrics, RadianceIsShownSrgbEncoded) {
    // IEC 61966-2-1: 0.5 is 0.735357, 0.002 is 12.92 times that.
    const Image shown = radiance_to_display(picture({4, 2, 0.008f, 9, -1, 0}), 4);
    EXPECT_THAT(shown.pixels, Pointwise(FloatNear(1e-5f), {1.0f, 0.735357f, 0.02584f, 1.0f, 0.0f, 0.0f}));
}

TEST(PictureMetrics, WhiteLeavesTheBrightestPercentOut) {
    Image image({100, 1}, 1);
    for (int x = 0; x < 100; ++x) image.at(99 - x, 0)[0] = static_cast<float>(x);
    EXPECT_EQ(display_white(image), 98);  // 99 of 100 values are at most 98
    Image firefly({300, 1}, 3);
    firefly.at(17, 0)[2] = 7;
    EXPECT_EQ(display_white(firefly), 7);
    EXPECT_EQ(display_white(Image({4, 4}, 3)), 1);
}

TEST(PictureMetrics, FlickerIsTheMeanChangeOverTheMean) {
    // Means 1, 2, 1, 4; changes 1, 1, 3 of mean 5 / 3; the mean of all is 2.
    const std::vector<Image> frames{picture({0, 1, 2}), picture({2, 1, 3}), picture({1, 1, 1}), picture({4, 4, 4})};
    // |2-0|, 0, |3-2|: mean 1; |1-2|, 0, |1-3|: mean 1; 3, 3, 3: mean 3.
    EXPECT_NEAR(flicker(frames), (5.0 / 3) / 2, 1e-12);
    const std::vector<Image> still(3, frames[1]);
    EXPECT_EQ(flicker(still), 0);
    const std::vector<Image> black(2, picture({0, 0, 0}));
    EXPECT_EQ(flicker(black), 0);
    EXPECT_THROW((void)flicker(std::span(frames).first(1)), Error);
    const std::vector<Image> sizes{picture({0, 0, 0}), picture({0, 0, 0, 0, 0, 0})};
    EXPECT_THROW((void)flicker(sizes), Error);
}

TEST(PictureMetrics, ResidualLightGoesFromOneToZero) {
    const Image on = picture({3, 3, 6}), off = picture({1, 1, 1});  // means 4 and 1
    EXPECT_NEAR(residual_light(on, on, off), 1, 1e-12);
    EXPECT_NEAR(residual_light(off, on, off), 0, 1e-12);
    EXPECT_NEAR(residual_light(picture({1, 1, 4}), on, off), 1.0 / 3, 1e-12);
    EXPECT_NEAR(residual_light(picture({0, 0, 0}), on, off), -1.0 / 3, 1e-12);
    EXPECT_THROW((void)residual_light(off, off, off), Error);
    EXPECT_THROW((void)residual_light(picture({1, 1, 1, 1, 1, 1}), on, off), Error);
}

TEST(PictureMetrics, TheFirstValueThatIsNotFiniteIsNamed) {
    Image image({5, 4}, 4);
    EXPECT_NO_THROW(require_finite(image, "a.exr"));
    image.at(0, 0)[3] = std::nanf("");  // alpha
    EXPECT_NO_THROW(require_finite(image, "a.exr"));
    image.at(4, 2)[0] = -std::numeric_limits<float>::infinity();
    image.at(1, 2)[2] = std::nanf("");
    image.at(0, 3)[0] = std::nanf("");
    EXPECT_THAT([&] { require_finite(image, "a.exr"); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr("a.exr"), HasSubstr("nan"), HasSubstr("channel 2"), HasSubstr("(1, 2)"))));
}

}  // namespace
}  // namespace tyndall
