#include "modules/volumetrics/src/media/media.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/core/error.h"
#include "modules/volumetrics/src/media/froxel_tiles.h"
#include "modules/volumetrics/src/reconstruction/noise.h"

namespace tyndall::volumetrics {
namespace {

Inputs view_inputs(glm::vec3 eye = glm::vec3(0), glm::vec3 look = {0, 0, -1}) {
    Inputs inputs;
    inputs.size = {160, 90};
    inputs.eye = eye;
    inputs.view = glm::lookAt(eye, look, {0, 1, 0});
    glm::mat4 p(0);
    p[1][1] = 1.5F;
    p[0][0] = p[1][1] * 9 / 16;
    p[2][3] = -1;
    p[3][2] = inputs.znear;
    inputs.projection = p;
    return inputs;
}

TEST(VolumetricsMedia, HomogeneousMediaAddAndAverageTheirAnisotropyByScattering) {
    Inputs inputs = view_inputs();
    inputs.global = {{.sigma_s = glm::vec3(0.3F), .sigma_a = {0.1F, 0, 0}, .anisotropy = 0.5F},
                     {.sigma_s = glm::vec3(0.1F), .anisotropy = -0.5F, .emission = {0, 1, 0}}};
    const FrameMedia media = gather_media(inputs, {});
    EXPECT_NEAR(media.data.homogeneous_sigma_s.r, 0.4, 1e-6);
    EXPECT_NEAR(media.data.homogeneous_sigma_s.w, 0.25, 1e-6);
    EXPECT_NEAR(media.data.homogeneous_sigma_t.r, 0.5, 1e-6);
    EXPECT_EQ(media.data.homogeneous_emission.g, 1);
    EXPECT_TRUE(media.has_global);
    EXPECT_TRUE(media.chromatic);
}

TEST(VolumetricsMedia, AirIsKeptApartAndHasNoPartInTheAnisotropy) {
    Inputs inputs = view_inputs();
    inputs.global = {{.sigma_s = {0.1F, 0.2F, 0.4F}, .anisotropy = 0.9F, .rayleigh = true},
                     {.sigma_s = glm::vec3(0.3F), .anisotropy = 0.5F},
                     {.sigma_s = glm::vec3(0.1F), .anisotropy = -0.5F},
                     {.sigma_s = {0.01F, 0.02F, 0.04F}, .anisotropy = 0.9F, .rayleigh = true, .height = true}};
    const FrameMedia media = gather_media(inputs, {});
    EXPECT_TRUE(media.rayleigh);
    EXPECT_NEAR(media.data.homogeneous_sigma_s.b, 0.8, 1e-6);
    EXPECT_NEAR(media.data.homogeneous_sigma_s.w, 0.25, 1e-6);
    EXPECT_NEAR(media.data.homogeneous_rayleigh.b, 0.4, 1e-6);
    EXPECT_NEAR(media.data.height[0].sigma_s_rayleigh.b, 0.04, 1e-6);
    EXPECT_EQ(media.data.height[0].emission_g.w, 0);
    inputs.global = {{.sigma_s = glm::vec3(0.3F)}};
    EXPECT_FALSE(gather_media(inputs, {}).rayleigh);
}

TEST(VolumetricsMedia, OnlyColouredExtinctionNeedsThreeTransmittances) {
    Inputs inputs = view_inputs();
    inputs.global = {{.sigma_s = {0.1F, 0.2F, 0.3F}, .sigma_a = {0.3F, 0.2F, 0.1F}}};
    EXPECT_FALSE(gather_media(inputs, {}).chromatic);  // whatever the sums are rounded to
    inputs.global = {{.sigma_s = glm::vec3(0.1F), .emission = {1, 0, 0}}};
    EXPECT_FALSE(gather_media(inputs, {}).chromatic);
    inputs.local = {{.center = {0, 0, -5}, .sigma_a = {1, 0, 0}}};
    EXPECT_TRUE(gather_media(inputs, {}).chromatic);
}

TEST(VolumetricsMedia, MediaThatDoNothingAreLeftOut) {
    Inputs inputs = view_inputs();
    inputs.global.assign(9, GlobalMedium{.height = true});
    inputs.local.assign(3, LocalMedium{.center = {0, 0, -5}});
    EXPECT_TRUE(gather_media(inputs, {}).empty());
    inputs.global.assign(5, GlobalMedium{.sigma_s = glm::vec3(1), .height = true});
    EXPECT_THROW((void)gather_media(inputs, {}), Error);
}

TEST(VolumetricsMedia, NoiseSeedsKeepAllTheirBits) {
    Inputs inputs = view_inputs();
    for (const int seed : {16777217, 2147483647, -1}) {
        inputs.local = {{.center = {0, 0, -5}, .sigma_a = glm::vec3(1), .noise_scale = 1, .noise_amount = 1}};
        inputs.local[0].noise_seed = seed;
        EXPECT_EQ(gather_media(inputs, {}).local.at(0).seed_grid.x, static_cast<unsigned>(seed));
    }
}

TEST(VolumetricsMedia, StepsFillTheRayAndGrowByTheStrength) {
    Inputs inputs = view_inputs();
    inputs.global = {{.sigma_s = glm::vec3(1)}};
    for (const int steps : {1, 2, 8, 1024})
        for (const float strength : {0.01F, 1.0F, 10.0F}) {
            const shared::VolumetricsData data =
                gather_media(
                    inputs,
                    {.march = {.steps = steps, .stepping = Stepping::exponential, .stepping_strength = strength}})
                    .data;
            double sum = 0, length = data.first_step, last = 0;
            for (int i = 0; i < steps; ++i, length *= data.step_growth) sum += last = length;
            EXPECT_NEAR(sum, 1, 1e-4) << steps << ' ' << strength;
            EXPECT_NEAR(std::log(last / data.first_step), steps > 1 ? strength : 0, 1e-3) << steps;
        }
}

// Against points drawn from the shapes: each is in a froxel of its medium's box.
TEST(VolumetricsMedia, FroxelBoundsHoldEveryPointInView) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const auto distribution : {DepthDistribution::linear, DepthDistribution::exponential}) {
        const Settings settings{.froxels = {.distribution = distribution}};
        for (int trial = 0; trial < 200; ++trial) {
            const Inputs inputs = view_inputs({unit(random), unit(random), unit(random)},
                                              {10 * unit(random), 5 * unit(random), 10 * unit(random)});
            const FroxelGrid grid = froxel_grid(inputs, settings);
            const LocalMedium medium{
                .center = {30 * unit(random), 10 * unit(random), 30 * unit(random)},
                .half_extent = {0.1F + 3 * std::abs(unit(random)), 0.1F + 3 * std::abs(unit(random)), 1},
                .rotation = glm::angleAxis(3 * unit(random), glm::normalize(glm::vec3(1, unit(random), 1)))};
            const IndexBox box = froxel_bounds(view_bounds(medium, inputs), grid);
            for (int i = 0; i < 100; ++i) {
                const glm::vec3 local = glm::vec3(unit(random), unit(random), unit(random)) * medium.half_extent;
                const glm::vec4 view = inputs.view * glm::vec4(medium.center + medium.rotation * local, 1);
                const float depth = -view.z;
                if (depth < grid.nearest || depth >= grid.farthest) continue;
                const glm::vec4 clip = inputs.projection * view;
                const glm::vec2 uv = 0.5F * glm::vec2(clip) / clip.w + 0.5F;
                if (uv.x < 0 || uv.y < 0 || uv.x >= 1 || uv.y >= 1) continue;
                const float w = distribution == DepthDistribution::linear
                                    ? (depth - grid.nearest) / (grid.farthest - grid.nearest)
                                    : std::log(depth / grid.nearest) / std::log(grid.farthest / grid.nearest);
                const glm::ivec3 index(glm::vec3(uv, w) * glm::vec3(grid.size));
                ASSERT_TRUE(glm::all(glm::greaterThanEqual(index, box.lower)) &&
                            glm::all(glm::lessThan(index, box.upper)));
            }
        }
    }
}

// Of the pixel that sees a point of a box, all four columns round it go as far as the point.
TEST(VolumetricsMedia, DepthsOfTransparentsHoldEveryPointInView) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    const glm::ivec2 columns{16, 9};
    int empty = 0, seen = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Inputs inputs = view_inputs({unit(random), unit(random), unit(random)},
                                    {10 * unit(random), 5 * unit(random), 10 * unit(random)});
        const glm::vec3 center(30 * unit(random), 10 * unit(random), 30 * unit(random));
        const glm::vec3 half = 0.1F + 2.0F * glm::abs(glm::vec3(unit(random), unit(random), unit(random)));
        inputs.transparents = {{center - half, center + half}};
        const std::vector<glm::vec2> depths = transparent_depths(inputs, columns);
        empty += static_cast<int>(std::ranges::count(depths, 0.0F, [](glm::vec2 d) { return d.y; }));
        for (int i = 0; i < 100; ++i) {
            const glm::vec3 point = center + half * glm::vec3(unit(random), unit(random), unit(random));
            const glm::vec4 view = inputs.view * glm::vec4(point, 1), clip = inputs.projection * view;
            const glm::vec2 uv = 0.5F * glm::vec2(clip) / clip.w + 0.5F;
            if (view.z > -inputs.znear || uv.x < 0 || uv.y < 0 || uv.x >= 1 || uv.y >= 1) continue;
            ++seen;
            const glm::ivec2 base(glm::floor(uv * glm::vec2(columns) - 0.5F));
            for (const glm::ivec2 corner : {glm::ivec2(0), {1, 0}, {0, 1}, {1, 1}}) {
                const glm::ivec2 c = glm::clamp(base + corner, glm::ivec2(0), columns - 1);
                const glm::vec2 d = depths[static_cast<std::size_t>(c.y) * columns.x + c.x];
                ASSERT_LE(d.x, -view.z);
                ASSERT_GE(d.y, -view.z);
            }
        }
    }
    EXPECT_GT(seen, 1000);
    EXPECT_GT(empty, 200 * columns.x * columns.y / 2) << "most columns are left out";
}

// Against points drawn from the shapes, near and far: each is in a tile that lists its medium.
TEST(VolumetricsMedia, TilesOfTheScreenListEveryMediumSeenInThem) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::size_t points = 0;
    for (int trial = 0; trial < 30; ++trial) {
        Inputs inputs = view_inputs({unit(random), unit(random), unit(random)},
                                    {10 * unit(random), 5 * unit(random), 10 * unit(random)});
        for (int i = 0; i < 40; ++i)
            inputs.local.push_back({.center = glm::vec3(unit(random), unit(random), unit(random)) * 300.0F,
                                    .half_extent = {0.1F + 30 * std::abs(unit(random)), 1, 2},
                                    .rotation = glm::angleAxis(3 * unit(random), glm::vec3(0, 0, 1)),
                                    .sigma_a = glm::vec3(1 + static_cast<float>(i))});
        const FrameMedia media = gather_media(inputs, {});
        const std::vector<std::uint32_t> lists = screen_media(media.local_bounds);
        const std::size_t words = (media.local.size() + 31) / 32;
        ASSERT_EQ(lists.size(), words * SCREEN_MEDIA_X * SCREEN_MEDIA_Y);
        for (const LocalMedium& medium : inputs.local)
            for (int k = 0; k < 20; ++k) {
                const glm::vec3 local = glm::vec3(unit(random), unit(random), unit(random)) * medium.half_extent;
                const glm::vec4 clip =
                    inputs.projection * inputs.view * glm::vec4(medium.center + medium.rotation * local, 1);
                if (clip.w <= 0 || std::abs(clip.x) >= clip.w || std::abs(clip.y) >= clip.w) continue;
                const auto index =
                    static_cast<std::size_t>(std::ranges::find_if(media.local,
                                                                  [&](const shared::LocalMedium& m) {
                                                                      return m.sigma_a_shape.x == medium.sigma_a.x;
                                                                  }) -
                                             media.local.begin());
                ASSERT_LT(index, media.local.size());
                const glm::ivec2 tile((0.5F * glm::vec2(clip) / clip.w + 0.5F) *
                                      glm::vec2(SCREEN_MEDIA_X, SCREEN_MEDIA_Y));
                const std::size_t first = words * static_cast<std::size_t>(tile.y * SCREEN_MEDIA_X + tile.x);
                EXPECT_TRUE(lists[first + index / 32] >> index % 32 & 1U);
                ++points;
            }
    }
    EXPECT_GT(points, 1000U);
}

TEST(VolumetricsMedia, LiveTilesHoldWhichBoxesMeetWhichTiles) {
    const glm::ivec3 froxels{50, 33, 5};  // 4 x 3 x 5 tiles
    std::vector<IndexBox> boxes(40, IndexBox{{0, 0, 0}, {50, 33, 3}});
    boxes[0] = {{15, 0, 2}, {17, 1, 3}};
    boxes[33] = {{48, 32, 4}, {50, 33, 5}};
    const std::vector<std::uint32_t> live = live_tiles(boxes, froxels);
    std::size_t next = 0;
    for (unsigned z = 0; z < 5; ++z)
        for (unsigned y = 0; y < 3; ++y)
            for (unsigned x = 0; x < 4; ++x) {
                const bool last = x == 3 && y == 2 && z == 4;
                if (z >= 3 && !last) continue;  // empty
                ASSERT_LE(next + 3, live.size());
                EXPECT_EQ(live[next], x | y << 10 | z << 20);
                EXPECT_EQ(live[next + 1], last ? 0U : 0xfffffffeU | unsigned(x < 2 && y == 0 && z == 2));
                EXPECT_EQ(live[next + 2], last ? 2U : 0xfdU);
                next += 3;
            }
    EXPECT_EQ(next, live.size());
}

TEST(VolumetricsMedia, NoiseTilesHoldEveryOffsetOnce) {
    EXPECT_EQ(noise_tile(Noise::none, 8), std::vector<float>{0.5F});
    for (const Noise noise : {Noise::white_tile, Noise::bayer})
        for (const int size : {2, 4, 8, 16}) {
            std::vector<float> tile = noise_tile(noise, size);
            std::sort(tile.begin(), tile.end());
            ASSERT_EQ(tile.size(), std::size_t(size) * size);
            for (std::size_t i = 0; i < tile.size(); ++i)
                EXPECT_FLOAT_EQ(tile[i], (static_cast<float>(i) + 0.5F) / static_cast<float>(tile.size()));
        }
}

// Of 256 shuffled values the correlation has a standard deviation of 1/16.
TEST(VolumetricsMedia, TheShuffledTileIsUncorrelated) {
    const std::vector<float> tile = noise_tile(Noise::white_tile, 16);
    const auto correlation = [&](std::size_t right, std::size_t down) {
        double sum = 0;
        for (std::size_t i = 0; i < 256; ++i)
            sum += 12 * (tile[i] - 0.5) * (tile[(i % 16 + right) % 16 + (i / 16 + down) % 16 * 16] - 0.5) / 256;
        return sum;
    };
    EXPECT_NEAR(correlation(0, 0), 1, 0.01);
    for (std::size_t i = 1; i < 9; ++i) {
        EXPECT_NEAR(correlation(i, 0), 0, 0.22) << i;
        EXPECT_NEAR(correlation(0, i), 0, 0.22) << i;
        EXPECT_NEAR(correlation(i, i), 0, 0.22) << i;
    }
}

TEST(VolumetricsMedia, OnlyNoiseThatChangesInTimeKnowsTheFrame) {
    Settings settings;
    settings.noise.time = NoiseTime::fixed;
    EXPECT_EQ(noise_uniform(settings, 7).z, 0U);
    settings.noise.time = NoiseTime::r2;
    EXPECT_EQ(noise_uniform(settings, 7), glm::uvec4(NOISE_BAYER, NOISE_TIME_R2, 7, 0));
    settings.noise.kind = Noise::none;
    EXPECT_EQ(noise_uniform(settings, 7).z, 0U);
    // A tile has no slices of its own.
    settings.noise.time = NoiseTime::own;
    settings.noise.kind = Noise::white_tile;
    EXPECT_EQ(noise_uniform(settings, 7).y, unsigned(NOISE_TIME_GOLDEN_RATIO));
    settings.noise.kind = Noise::fast;
    EXPECT_EQ(noise_uniform(settings, 7), glm::uvec4(NOISE_FAST, NOISE_TIME_OWN, 7, 0));
    settings.noise.fast_space = SpatialKernel::box5;
    settings.noise.fast_time = TemporalKernel::box8;
    EXPECT_EQ(noise_texture_name(settings), "fast_box8_box5_128x128x32_r8.raw");
}

}  // namespace
}  // namespace tyndall::volumetrics
