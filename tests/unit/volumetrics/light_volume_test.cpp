#include "light/light_volume.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <random>

#include "media/shape.h"

namespace tyndall::test {
namespace {

using volumetrics::dimmed_texels;
using volumetrics::IndexBox;
using volumetrics::LightRays;
using volumetrics::LocalMedium;
using volumetrics::Shape;

bool holds(const IndexBox& box, glm::ivec3 texel) {
    return glm::all(glm::greaterThanEqual(texel, box.lower)) && glm::all(glm::lessThan(texel, box.upper));
}

class DimmedTexels : public ::testing::Test {
  protected:
    LocalMedium random_medium() {
        LocalMedium medium;
        medium.shape = Shape::box;
        medium.center = 4.0f * random();
        medium.half_extent = glm::abs(2.0f * random()) + 0.01f;
        medium.rotation = glm::normalize(glm::quat(1, random().x, random().y, random().z));
        return medium;
    }
    glm::vec3 random() { return {uniform_(engine_), uniform_(engine_), uniform_(engine_)}; }
    static glm::vec3 in_world(const LocalMedium& medium, glm::vec3 of_box) {
        return medium.center + medium.rotation * (of_box * medium.half_extent);
    }

  private:
    std::mt19937 engine_{3};
    std::uniform_real_distribution<float> uniform_{-1, 1};
};

// A point of the medium lies on the slab that ends at the texel above it, in the texel of its column or beside it.
TEST_F(DimmedTexels, OfTheSunHoldEverySlabThatMeetsTheMedium) {
    std::size_t texels = 0;
    for (int round = 0; round < 200; ++round) {
        const LocalMedium medium = random_medium();
        const glm::mat4 turn = glm::mat4_cast(glm::normalize(glm::quat(1, random().x, random().y, random().z)));
        const LightRays rays{
            .size = {20, 16, 12},
            .volume_to_world =
                turn * glm::scale(glm::translate(glm::mat4(1), glm::vec3(-6, -7, -8)), glm::vec3(12, 14, 16)),
            .media_count = 1};
        const IndexBox box = dimmed_texels(rays, pack_shape(medium));
        if (!box.empty()) texels += static_cast<std::size_t>(glm::compMul(box.upper - box.lower));
        for (int i = 0; i < 100; ++i) {
            const glm::vec4 at = glm::inverse(rays.volume_to_world) * glm::vec4(in_world(medium, random()), 1);
            const glm::vec3 p = glm::vec3(at) * glm::vec3(rays.size);
            const glm::ivec3 texel(glm::floor(glm::vec3(p.x, p.y, p.z + 0.5f)));
            if (glm::any(glm::lessThan(texel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(texel, rays.size)))
                continue;
            ASSERT_TRUE(holds(box, texel)) << round << ' ' << texel.x << ' ' << texel.y << ' ' << texel.z;
        }
    }
    EXPECT_LT(texels, 200u * 20 * 16 * 12 / 3) << "most of them are left out";
}

TEST_F(DimmedTexels, OfALampHoldEveryDistanceOfTheMedium) {
    for (int round = 0; round < 200; ++round) {
        const LocalMedium medium = random_medium();
        const LightRays rays{
            .size = {10, 10, 24}, .lamp = 3.0f * random(), .media_count = 1, .begin = 0.5f, .end = 9};
        const IndexBox box = dimmed_texels(rays, pack_shape(medium));
        for (int i = 0; i < 100; ++i) {
            const float distance = glm::distance(rays.lamp, in_world(medium, random()));
            const int slab =
                static_cast<int>(std::floor((distance - rays.begin) / (rays.end - rays.begin) * 23)) + 1;
            if (slab < 1 || slab > 23) continue;
            ASSERT_TRUE(holds(box, {0, 9, slab})) << round << ' ' << slab;
        }
    }
}

TEST_F(DimmedTexels, AreAllWhereNumbersHaveNoBounds) {
    for (const float odd :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e38f}) {
        LocalMedium medium = random_medium();
        medium.half_extent = glm::vec3(odd);
        for (const LightRays& rays : {LightRays{.size = {8, 6, 4}, .media_count = 1},
                                      LightRays{.size = {8, 6, 4}, .media_count = 1, .begin = 1, .end = 9}}) {
            const IndexBox box = dimmed_texels(rays, pack_shape(medium));
            EXPECT_EQ(box.lower, glm::ivec3(0)) << odd;
            EXPECT_EQ(box.upper, rays.size) << odd;
        }
    }
}

TEST_F(DimmedTexels, AreNoneFarFromTheLight) {
    LocalMedium medium = random_medium();
    medium.center = {0, 0, 100};
    EXPECT_TRUE(
        dimmed_texels({.size = {8, 8, 8}, .media_count = 1, .begin = 1, .end = 9}, pack_shape(medium)).empty());
    EXPECT_TRUE(dimmed_texels({.size = {8, 8, 8}, .media_count = 1}, pack_shape(medium)).empty());
}

}  // namespace
}  // namespace tyndall::test
