#include "engine/render/shadow_tiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "shaders/shared/shadows.h"

namespace tyndall {
namespace {

using testing::ElementsAre;

TEST(ShadowTiles, LevelHalvesWithTwiceTheDistance) {
    EXPECT_EQ(shadow_tile_level(10, 10, 512, -1), 9);
    EXPECT_EQ(shadow_tile_level(10, 20, 512, -1), 8);
    EXPECT_EQ(shadow_tile_level(10, 80, 512, -1), 6);
    EXPECT_EQ(shadow_tile_level(10, 1e9f, 512, -1), 0);
    EXPECT_EQ(shadow_tile_level(10, 0, 512, -1), shadow_tile_level(10, 0.1f, 512, -1));
}

// Back and forth over the distance where the rounded level changes: it may change once, then stays.
TEST(ShadowTiles, LevelHasHysteresis) {
    const float boundary = 10 * std::sqrt(2.0f);
    int level = shadow_tile_level(10, boundary * 0.98f, 512, -1);
    int changes = 0;
    for (int i = 0; i < 100; ++i) {
        const int next = shadow_tile_level(10, boundary * (i % 2 == 0 ? 1.05f : 0.95f), 512, level);
        changes += next != level;
        level = next;
    }
    EXPECT_EQ(changes, 0);
    EXPECT_NE(shadow_tile_level(10, boundary * 1.5f, 512, level), level);
}

TEST(ShadowTiles, SizesAreAsDemandedWhileTheyFit) {
    const TileDemand demands[] = {{9, 6}, {12, 1}, {7, 6}, {1, 1}};
    EXPECT_THAT(plan_tile_sizes(demands, 512, 4096LL * 4096), ElementsAre(512, 512, 128, 16));
}

TEST(ShadowTiles, FullAtlasShrinksTheLeastImportantFirst) {
    // 4 x 128² fill the area; one demand more.
    const TileDemand demands[] = {{7, 1}, {7, 1}, {7, 1}, {7, 1}, {6, 1}};
    EXPECT_THAT(plan_tile_sizes(demands, 512, 256LL * 256), ElementsAre(128, 128, 128, 64, 64));
}

TEST(ShadowTiles, AnyDemandFitsUntilAllAreSmallest) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<TileDemand> demands(1 + random() % 400);
        for (TileDemand& d : demands) d = {static_cast<int>(random() % 14), random() % 2 == 0 ? 6 : 1};
        const long long area = 1024LL * 1024;
        const auto sizes = plan_tile_sizes(demands, 512, area);
        long long used = 0;
        for (std::size_t i = 0; i < sizes.size(); ++i) used += 1LL * demands[i].tiles * sizes[i] * sizes[i];
        ASSERT_LE(used, area);
        for (std::size_t i = 0; i < sizes.size(); ++i) {  // 2400 tiles of 16² fit
            ASSERT_GE(sizes[i], 16);
            for (std::size_t j = 0; j < sizes.size(); ++j)
                if (demands[i].level > demands[j].level && demands[i].tiles == demands[j].tiles) {
                    ASSERT_GE(sizes[i], sizes[j]);
                }
        }
    }
}

TEST(ShadowTiles, LastResortIsNoTileForTheLeastImportant) {
    const TileDemand demands[] = {{4, 1}, {2, 1}, {9, 1}, {5, 1}, {6, 1}};
    EXPECT_THAT(plan_tile_sizes(demands, 512, 32LL * 32), ElementsAre(16, 0, 16, 16, 16));
}

Light lamp(LightType type) {
    Light light;
    light.type = type;
    light.range = 20;
    light.radius = 0.1f;
    light.outer_cone = 0.6f;
    return light;
}

TEST(ShadowTiles, SpotMapsItsConeInsideTheBorder) {
    const Light light = lamp(LightType::spot);
    const glm::mat4 pose = glm::translate(glm::mat4(1), {3, 4, 5}) *
                           glm::rotate(glm::mat4(1), 0.8f, glm::normalize(glm::vec3(1, 2, -1)));
    const AtlasTile place{{256, 128}, 128};
    const shared::ShadowTile tile = make_shadow_tile(light, pose, 0, place, 1024);
    EXPECT_EQ(tile.rect, glm::vec4(0.25f, 0.125f, 0.125f, 0.5f / 1024));
    EXPECT_FLOAT_EQ(tile.depth.x, 0.1f);
    EXPECT_FLOAT_EQ(tile.depth.y, 20);
    const glm::vec3 axis = -glm::vec3(pose[2]), right = glm::vec3(pose[0]);
    const auto project = [&](float distance, float angle) {
        const glm::vec3 p = glm::vec3(pose[3]) + distance * (std::cos(angle) * axis + std::sin(angle) * right);
        const glm::vec4 clip = tile.world_to_clip * glm::vec4(p, 1);
        return glm::vec3(clip) / clip.w;
    };
    EXPECT_NEAR(project(0.1f, 0).z, 1, 1e-5);
    EXPECT_NEAR(project(20, 0).z, 0, 1e-5);
    EXPECT_GT(project(2, 0).z, project(3, 0).z);
    // The cone's rim: SHADOW_TILE_BORDER texels from the side.
    const glm::vec2 rim(project(5, 0.6f));
    EXPECT_NEAR(glm::length(rim), 1 - 2.0f * SHADOW_TILE_BORDER / 128, 1e-4);
    // One texel at 1 m.
    const glm::vec4 w1 = tile.world_to_clip * glm::vec4(glm::vec3(pose[3]) + axis + tile.depth.z * right, 1);
    EXPECT_NEAR(glm::length(glm::vec2(w1)) / w1.w * 64, 1, 1e-3);
}

TEST(ShadowTiles, FacesOfAPointLightCoverAllDirectionsWithABorder) {
    const Light light = lamp(LightType::point);
    const glm::mat4 pose = glm::translate(glm::mat4(1), {1, -2, 3});
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 a = glm::abs(d);
        const int major = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
        const int face = 2 * major + (d[major] < 0 ? 1 : 0);
        const shared::ShadowTile tile = make_shadow_tile(light, pose, face, {{0, 0}, 64}, 256);
        const glm::vec4 clip = tile.world_to_clip * glm::vec4(glm::vec3(pose[3]) + 5.0f * d, 1);
        ASSERT_NEAR(clip.w, 5 * a[major], 1e-4);
        const float limit = 1 - 2.0f * SHADOW_TILE_BORDER / 64 + 1e-5f;
        ASSERT_LE(std::max(std::abs(clip.x), std::abs(clip.y)) / clip.w, limit);
    }
}

}  // namespace
}  // namespace tyndall
