#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/depth.glsl"
#include "shaders/lib/froxel.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;

const glm::vec2 kTanHalfFov{0.9f, 0.5f};
const glm::ivec3 kSize{160, 90, 64};

TEST(Depth, BufferAndViewDepthAreInverse) {
    for (float z_near : {0.01f, 0.1f, 1.0f}) {
        EXPECT_EQ(glsl::view_depth_from_buffer(1.0f, z_near), z_near);
        for (float z = z_near; z < 1e6f; z *= 1.7f) {
            EXPECT_NEAR(glsl::view_depth_from_buffer(glsl::buffer_from_view_depth(z, z_near), z_near) / z, 1.0f,
                        3e-7f);
        }
    }
}

// The third row of a reversed-Z projection with an infinite far plane: clip z = near, clip w = -view z.
TEST(Depth, AgreesWithTheProjectionMatrix) {
    const float z_near = 0.25f;
    glm::mat4 projection(0.0f);
    projection[0][0] = 1.0f / kTanHalfFov.x;
    projection[1][1] = 1.0f / kTanHalfFov.y;
    projection[2][3] = -1.0f;
    projection[3][2] = z_near;
    const glm::vec3 point{-3.0f, 2.0f, -17.0f};
    const glm::vec4 clip = projection * glm::vec4(point, 1.0f);
    const float view_depth = glsl::view_depth_from_buffer(clip.z / clip.w, z_near);
    EXPECT_NEAR(view_depth, 17.0f, 1e-5f);
    const glm::vec3 back =
        glsl::view_position_from_ndc(glm::vec2(clip.x / clip.w, clip.y / clip.w), view_depth, kTanHalfFov);
    EXPECT_NEAR(glm::length(back - point), 0.0f, 1e-5f);
    EXPECT_NEAR(glsl::ray_distance_from_view_depth(view_depth, 17.0f / glm::length(point)), glm::length(point),
                1e-5f);
}

TEST(Depth, InfinityIsFiniteAndFarthest) {
    EXPECT_EQ(glsl::view_depth_from_buffer(0.0f, 0.1f), glsl::MAX_VIEW_DEPTH);
    EXPECT_LE(glsl::view_depth_from_buffer(1e-38f, 0.1f), glsl::MAX_VIEW_DEPTH);
    EXPECT_TRUE(std::isfinite(glsl::MAX_VIEW_DEPTH * glsl::MAX_VIEW_DEPTH));
    EXPECT_TRUE(glsl::is_background(0.0f));
    EXPECT_FALSE(glsl::is_background(1e-7f));
}

TEST(Froxel, EndsOfTheRange) {
    for (int distribution : {glsl::FROXEL_LINEAR, glsl::FROXEL_EXPONENTIAL}) {
        EXPECT_NEAR(glsl::froxel_view_depth_from_w(distribution, 0.0f, 0.5f, 128.0f), 0.5f, 1e-6f);
        EXPECT_NEAR(glsl::froxel_view_depth_from_w(distribution, 1.0f, 0.5f, 128.0f), 128.0f, 1e-3f);
        EXPECT_LT(glsl::froxel_w_from_view_depth(distribution, 0.25f, 0.5f, 128.0f), 0.0f);
        EXPECT_GT(glsl::froxel_w_from_view_depth(distribution, 129.0f, 0.5f, 128.0f), 1.0f);
        EXPECT_TRUE(std::isfinite(glsl::froxel_w_from_view_depth(distribution, 0.0f, 0.5f, 128.0f)));
    }
}

TEST(Froxel, MiddleOfTheRangeIsTheArithmeticOrGeometricMean) {
    EXPECT_NEAR(glsl::froxel_view_depth_from_w(glsl::FROXEL_LINEAR, 0.5f, 0.5f, 128.0f), 64.25f, 1e-4f);
    EXPECT_NEAR(glsl::froxel_view_depth_from_w(glsl::FROXEL_EXPONENTIAL, 0.5f, 0.5f, 128.0f), 8.0f, 1e-5f);
}

TEST(Froxel, DepthRoundTripIsMonotone) {
    for (int distribution : {glsl::FROXEL_LINEAR, glsl::FROXEL_EXPONENTIAL, glsl::FROXEL_LOGARITHMIC}) {
        float previous = -1.0f;
        for (int i = 0; i <= 256; ++i) {
            const float w = static_cast<float>(i) / 256.0f;
            const float z = glsl::froxel_view_depth_from_w(distribution, w, 0.1f, 400.0f);
            EXPECT_GT(z, previous);
            previous = z;
            EXPECT_NEAR(glsl::froxel_w_from_view_depth(distribution, z, 0.1f, 400.0f), w, 1e-6f);
        }
    }
}

TEST(Froxel, IndexPositionRoundTrip) {
    for (int distribution : {glsl::FROXEL_LINEAR, glsl::FROXEL_EXPONENTIAL}) {
        for (const glm::ivec3& index : {glm::ivec3(0), glm::ivec3(159, 89, 63), glm::ivec3(31, 77, 12)}) {
            for (float jitter : {-0.49f, 0.0f, 0.49f}) {
                const glm::vec3 uvw = glsl::froxel_uvw_from_index(index, glm::vec3(jitter), kSize);
                const glm::vec3 position =
                    glsl::froxel_view_position_from_uvw(uvw, distribution, 0.1f, 100.0f, kTanHalfFov);
                EXPECT_LT(position.z, 0.0f);
                const glm::vec3 back =
                    glsl::froxel_uvw_from_view_position(position, distribution, 0.1f, 100.0f, kTanHalfFov);
                EXPECT_NEAR(glm::length(back - uvw), 0.0f, 2e-6f);
                EXPECT_EQ(glsl::froxel_index_from_uvw(back, kSize), index);
            }
        }
    }
}

TEST(Froxel, CornersOfTheScreen) {
    const glm::vec3 corner = glsl::froxel_view_position_from_uvw(glm::vec3(1.0f, 0.0f, 1.0f), glsl::FROXEL_LINEAR,
                                                                 1.0f, 10.0f, kTanHalfFov);
    EXPECT_NEAR(glm::length(corner - glm::vec3(9.0f, -5.0f, -10.0f)), 0.0f, 1e-5f);
}

TEST(Froxel, PointsOutsideGetTheNearestIndex) {
    EXPECT_EQ(glsl::froxel_index_from_uvw(glm::vec3(-0.2f, 1.0f, 7.0f), kSize), glm::ivec3(0, 89, 63));
}

/// A table of 16 segments with the given lengths.
struct Table {
    glm::mat4 begins{0.0f}, lengths{0.0f};
    float end = 0.0f;

    explicit Table(float begin, const std::vector<float>& segments) : end(begin) {
        for (int i = 0; i < 16; ++i) {
            begins[i / 4][i % 4] = end;
            lengths[i / 4][i % 4] = segments[static_cast<std::size_t>(i)];
            end += segments[static_cast<std::size_t>(i)];
        }
    }
    [[nodiscard]] float w(float depth) const { return glsl::froxel_w_from_table(depth, begins, lengths); }
    [[nodiscard]] float depth(float w) const { return glsl::froxel_view_depth_from_table(w, begins, lengths); }
};

TEST(FroxelTable, AnEvenTableIsTheLinearDistribution) {
    const Table table(2.0f, std::vector<float>(16, 0.5f));
    for (float w = -0.5f; w <= 1.5f; w += 0.01f) {
        const float depth = glsl::froxel_view_depth_from_w(glsl::FROXEL_LINEAR, w, 2.0f, 10.0f);
        EXPECT_NEAR(table.depth(w), depth, 2e-6f);
        EXPECT_NEAR(table.w(depth), w, 1e-6f);
    }
}

TEST(FroxelTable, EachSegmentIsASixteenthOfTheSlices) {
    std::vector<float> lengths(16);
    for (std::size_t i = 0; i < 16; ++i) lengths[i] = 0.25f * static_cast<float>(1 + i % 5);
    const Table table(1.0f, lengths);
    float begin = 1.0f;
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_NEAR(table.depth(static_cast<float>(i) / 16.0f), begin, 1e-5f);
        EXPECT_NEAR(table.depth((static_cast<float>(i) + 0.25f) / 16.0f), begin + 0.25f * lengths[i], 1e-5f);
        begin += lengths[i];
    }
    EXPECT_NEAR(table.depth(1.0f), begin, 1e-5f);
}

TEST(FroxelTable, RoundTripOfRandomTablesRises) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(-4.0f, 0.0f), start(0.0f, 30.0f);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<float> lengths(16);
        float far = 0.0f;
        for (float& length : lengths) far += length = 100.0f * std::pow(10.0f, exponent(random));
        const Table table(trial % 2 == 0 ? 0.0f : start(random), lengths);
        float previous = table.depth(-0.01f);
        for (int i = 0; i <= 256; ++i) {
            const float w = static_cast<float>(i) / 256.0f, depth = table.depth(w);
            ASSERT_GT(depth, previous) << trial << ' ' << i;
            ASSERT_NEAR(table.depth(table.w(depth)), depth, 1e-6f * (far + depth)) << trial << ' ' << i;
            previous = depth;
        }
        EXPECT_LT(table.w(table.begins[0][0] - 1.0f), 0.0f);
        EXPECT_GT(table.w(1.001f * table.end + 0.001f), 1.0f);
    }
}

}  // namespace
