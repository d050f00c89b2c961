#include "modules/volumetrics/src/media/froxel_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace tyndall::volumetrics {
namespace {

/// A camera at `eye` that looks along -Z.
Inputs view_inputs(glm::vec3 eye = glm::vec3(0)) {
    Inputs inputs;
    inputs.size = {160, 90};
    inputs.eye = eye;
    inputs.view = glm::translate(glm::mat4(1), -eye);
    glm::mat4 p(0);
    p[1][1] = 1.5F;
    p[0][0] = p[1][1] * 9 / 16;
    p[2][3] = -1;
    p[3][2] = inputs.znear;
    inputs.projection = p;
    return inputs;
}

constexpr DepthDistribution distributions[] = {DepthDistribution::linear, DepthDistribution::exponential,
                                               DepthDistribution::logarithmic, DepthDistribution::curve,
                                               DepthDistribution::automatic};

/// Slices rise by more than single precision's step, and each depth finds its slice.
void expect_rising_round_trip(const FroxelGrid& grid) {
    float previous = -1;
    for (int i = 0; i <= 4 * grid.size.z; ++i) {
        const float w = static_cast<float>(i) / static_cast<float>(4 * grid.size.z), depth = grid.view_depth(w);
        ASSERT_TRUE(std::isfinite(depth));
        ASSERT_GT(depth, previous * (previous > 0 ? 1.000001F : 1)) << "distribution " << grid.distribution;
        ASSERT_NEAR(grid.view_depth(grid.w(depth)), depth, 2e-6F * grid.farthest);
        previous = depth;
    }
    EXPECT_GE(grid.view_depth(0), 0);
    EXPECT_NEAR(grid.view_depth(1), grid.farthest, 2e-6F * grid.farthest);
}

TEST(FroxelGrid, SmallPicturesHaveFewerColumns) {
    Settings settings;
    settings.froxels.pixels = 6;
    const auto columns = [&](int width, int height) { return froxel_size(settings, {width, height}); };
    EXPECT_EQ(columns(1920, 1080), glm::ivec3(80, 45, 64));
    EXPECT_EQ(columns(240, 135), glm::ivec3(40, 24, 64)) << "of 6 px 40 and 22.5";
    EXPECT_EQ(columns(241, 120), glm::ivec3(48, 20, 64)) << "none too few";
    EXPECT_EQ(columns(1, 1), glm::ivec3(8, 8, 64)) << "the least that can be set";
    EXPECT_EQ(columns(4096, 16), glm::ivec3(80, 8, 64));
    settings.froxels.pixels = 0;
    EXPECT_EQ(columns(1, 1), glm::ivec3(80, 45, 64));
}

TEST(FroxelGrid, SlicesRiseAndComeBackWhateverIsSet) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto spread = [&](float lowest, float highest) {
        return lowest * std::pow(highest / lowest, unit(random));
    };
    for (int trial = 0; trial < 400; ++trial) {
        Settings settings;
        settings.froxels.z = 8 + static_cast<int>(248 * unit(random));
        settings.froxels.far = spread(4, 4096);
        for (const auto member : froxel_curve_settings)
            settings.froxels.*member =
                unit(random) < 0.3F ? (unit(random) < 0.5F ? 0.001F : 1000.0F) : spread(0.001F, 1000);
        Inputs inputs = view_inputs({spread(0.1F, 1e4F), spread(0.01F, 1e3F), 0});
        inputs.znear = spread(0.001F, 10);
        inputs.has_sun = unit(random) < 0.5F;
        if (unit(random) < 0.5F)
            inputs.lamps.push_back({.position = inputs.eye + glm::vec3(0, 0, -spread(0.01F, 100))});
        if (unit(random) < 0.5F)
            inputs.global.push_back({.sigma_s = glm::vec3(spread(1e-6F, 1e4F)),
                                     .height = unit(random) < 0.5F,
                                     .falloff = spread(0.01F, 1e4F)});
        for (int i = 0; i < trial % 4; ++i)
            inputs.local.push_back({.center = inputs.eye + glm::vec3(0, 0, 50 - spread(1, 5000)),
                                    .half_extent = glm::vec3(spread(1e-3F, 1e3F)),
                                    .sigma_s = glm::vec3(spread(1e-6F, 1e4F))});
        for (const auto distribution : distributions) {
            settings.froxels.distribution = distribution;
            expect_rising_round_trip(froxel_grid(inputs, settings));
            if (HasFatalFailure()) return;
        }
    }
}

TEST(FroxelCurve, GoesThroughTheSumsOfItsParts) {
    Settings settings;
    const float parts[] = {1, 3, 2, 0.5F, 4, 8, 0.25F, 1.25F};  // sum 20
    for (std::size_t i = 0; i < 8; ++i) settings.froxels.*froxel_curve_settings[i] = parts[i];
    const std::array<float, 17> y = froxel_curve(settings);
    float sum = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(y[2 * i], sum / 20, 1e-6F);
        EXPECT_LT(y[2 * i], y[2 * i + 1]);
        EXPECT_LT(y[2 * i + 1], y[2 * i + 2]);
        sum += parts[i];
    }
    EXPECT_FLOAT_EQ(y[16], 1);
    settings = {};
    for (const auto member : froxel_curve_settings) settings.froxels.*member = 7;
    for (std::size_t k = 0; k <= 16; ++k)
        EXPECT_NEAR(froxel_curve(settings)[k], static_cast<float>(k) / 16, 1e-6F) << "a straight line";
}

TEST(FroxelAuto, SlicesLieWhereTheMediumIs) {
    Inputs inputs = view_inputs();
    inputs.has_sun = true;
    inputs.local = {
        {.shape = Shape::box, .center = {0, 0, -30}, .half_extent = {2, 2, 4}, .sigma_s = glm::vec3(0.05F)}};
    const Settings settings{.froxels = {.distribution = DepthDistribution::automatic}};
    const FroxelGrid grid = froxel_grid(inputs, settings);
    EXPECT_LE(grid.view_depth(0.5F / 64), 26) << "the middle of the first slice, which begins at the eye";
    EXPECT_GT(grid.view_depth(0.5F / 64), 25);
    EXPECT_GE(grid.farthest, 34);
    EXPECT_LT(grid.farthest, 34.1F);
    // Nothing to see: any slices, up to the far end.
    inputs.local.clear();
    EXPECT_NEAR(froxel_grid(inputs, settings).farthest, settings.froxels.far, 0.1F);
    // A global medium is everywhere.
    inputs.local = {
        {.shape = Shape::box, .center = {0, 0, -30}, .half_extent = {2, 2, 4}, .sigma_s = glm::vec3(0.05F)}};
    inputs.global = {{.sigma_s = glm::vec3(0.001F)}};
    EXPECT_EQ(froxel_grid(inputs, settings).nearest, 0);
    EXPECT_NEAR(froxel_grid(inputs, settings).farthest, settings.froxels.far, 0.1F);
}

/// Of the slices, the share before a view depth.
float share_before(const Inputs& inputs, float depth) {
    return froxel_grid(inputs, {.froxels = {.distribution = DepthDistribution::automatic}}).w(depth);
}

TEST(FroxelAuto, DenseMediaAndLampsDrawSlices) {
    Inputs thin = view_inputs(), dense = view_inputs();
    thin.has_sun = dense.has_sun = true;
    thin.global = {{.sigma_s = glm::vec3(0.001F)}};
    dense.global = {{.sigma_s = glm::vec3(0.2F)}};
    EXPECT_GT(share_before(dense, 10), share_before(thin, 10) + 0.1F) << "behind 10 m, two thirds of it are dark";
    Inputs lamp = thin, sun = thin;
    lamp.has_sun = false;
    lamp.lamps = {{.position = {0, 0, -60}}};
    const auto around = [](const Inputs& inputs) { return share_before(inputs, 65) - share_before(inputs, 55); };
    EXPECT_GT(around(lamp), 2 * around(sun));
}

// What the camera does in a frame moves no slice by more than 1 m for 0.1 m: light does not jump.
TEST(FroxelAuto, SlicesMoveAsTheCameraDoes) {
    const Settings settings{.froxels = {.distribution = DepthDistribution::automatic}};
    Inputs inputs = view_inputs();
    inputs.has_sun = true;
    inputs.local = {{.center = {0, 0, -30}, .half_extent = {5, 2, 8}, .sigma_s = glm::vec3(0.05F)},
                    {.center = {6, 0, -60}, .half_extent = {5, 2, 8}, .sigma_s = glm::vec3(0.3F)}};
    std::array<float, 65> last{};
    for (int frame = 0; frame < 300; ++frame) {  // 0.1 m a frame, from before the media through both
        inputs.view = glm::translate(glm::mat4(1), glm::vec3(0, 0, 0.1F * static_cast<float>(frame)));
        const FroxelGrid grid = froxel_grid(inputs, settings);
        for (int slice = 0; slice <= 64; ++slice) {
            const float depth = grid.view_depth(static_cast<float>(slice) / 64);
            if (frame > 0) {
                ASSERT_NEAR(depth, last[static_cast<std::size_t>(slice)], 1.0F) << frame << ", " << slice;
            }
            last[static_cast<std::size_t>(slice)] = depth;
        }
    }
}

}  // namespace
}  // namespace tyndall::volumetrics
