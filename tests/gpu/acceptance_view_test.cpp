// The layer acceptance, and the display that shows it: red where nothing of earlier frames is taken, green where
// all is.
#include <gtest/gtest.h>

#include <cmath>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/files.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

using namespace volumetrics;

class AcceptanceView : public GlTest {
  protected:
    AcceptanceView() {
        builder_.ground({0, -1, 0}, 50);
        builder_.box({0, 0, 4}, {0.01F, 3, 0.2F});  // 4 m before the eye
        builder_.sun({-1, -2, -1}, glm::vec3(10000));
        Medium fog;
        fog.sigma_s = glm::vec3(0.02F);
        builder_.scene.media.push_back(fog);
        options_.layer = "acceptance";
        volumetrics_.settings.technique = "ray_march";
        volumetrics_.settings.temporal.mode = Temporal::acceptance;
        volumetrics_.settings.temporal.weight = 0.5F;  // no more than the camera's travel leaves
        volumetrics_.settings.noise.kind = Noise::none;
        renderer_.prepare(builder_.finish());
    }
    Image draw() {
        const View view = look_at({eye_x_, 0, 8}, {eye_x_, 0, 0}, 0.05F, 0.1F, 1.5F);
        renderer_.render(builder_.scene, view, size_, options_);
        return renderer_.read_layer();
    }
    /// The share of pixels for which `holds`.
    template <class Holds>
    static double share(const Image& image, Holds holds) {
        int count = 0;
        for (int y = 0; y < image.size.y; ++y)
            for (int x = 0; x < image.size.x; ++x) count += holds(image.at(x, y)) ? 1 : 0;
        return double(count) / (image.size.x * image.size.y);
    }
    static bool red(const float* p) { return p[0] == 1 && p[1] == 0 && p[2] == 0; }
    static bool green(const float* p) { return p[0] < 0.01F && p[1] > 0.99F && p[2] == 0; }
    static bool black(const float* p) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }

    test::SceneBuilder builder_;
    glm::ivec2 size_{75, 50};
    float eye_x_ = 0;
    FrameOptions options_;
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
};

TEST_F(AcceptanceView, RedAtFirstGreenWhileNothingChangesRedBehindWhatMovedAway) {
    EXPECT_EQ(share(draw(), red), 1);
    EXPECT_EQ(share(draw(), green), 1);
    // The pole moves 0.02 / (2 * 3.8 * tan(0.025) * 1.5) = 7.0% of the width against what is far behind.
    eye_x_ = 0.02F;
    const Image moved = draw();
    const int y = size_.y / 4;  // above the horizon
    const auto column = [&](float u) { return moved.at(static_cast<int>(u * float(size_.x)), y); };
    const float then = 0.5F, now = 0.5F - 0.02F / (2 * 3.8F * std::tan(0.025F) * 1.5F);
    EXPECT_LT(column(then)[1], 0.1F) << "it stood here";
    EXPECT_GT(column(now)[1], 0.9F) << "its own surface was seen before";
    EXPECT_GT(column(0.2F)[1], 0.9F) << "so was the sky";
}

TEST_F(AcceptanceView, BlackWithoutATemporalFilter) {
    volumetrics_.settings.temporal.mode = Temporal::off;
    EXPECT_EQ(share(draw(), black), 1);
    const Image picture = renderer_.read_display();
    volumetrics_.show_acceptance = true;
    draw();
    EXPECT_EQ(renderer_.read_display().pixels, picture.pixels);
}

TEST_F(AcceptanceView, TheDisplayShowsTheLayer) {
    volumetrics_.show_acceptance = true;
    options_.more_layers = {"color"};
    draw();
    eye_x_ = 0.02F;
    const Image layer = draw(), display = renderer_.read_display();
    double most = 0;
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x)
            for (int c = 0; c < 3; ++c)
                most = std::max(most, double(std::abs(layer.at(x, y)[c] - display.at(x, y)[c])));
    EXPECT_LE(most, 0.5 / 255 + 1e-4);
    EXPECT_GT(share(layer, red), 0);
    EXPECT_GT(share(layer, green), 0);
    EXPECT_EQ(share(renderer_.read_layer("color"), black), 0) << "what lies below is drawn";
}

TEST_F(AcceptanceView, OfALowerResolutionFillsTheFrame) {
    volumetrics_.settings.temporal.place = TemporalPlace::before;
    for (const Resolution resolution : {Resolution::half, Resolution::quarter}) {
        volumetrics_.settings.resolution.size = resolution;
        EXPECT_EQ(share(draw(), red), 1);
        const Image still = draw();
        EXPECT_EQ(still.size, size_);
        EXPECT_EQ(share(still, green), 1);
    }
}

}  // namespace
}  // namespace tyndall
