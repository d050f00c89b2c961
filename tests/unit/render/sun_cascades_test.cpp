#include "engine/render/sun_cascades.h"

#include <gtest/gtest.h>

#include <random>

namespace tyndall {
namespace {

constexpr int cascade_size = 1024, map_size = cascade_map_size(cascade_size);
const glm::vec3 sun_direction = glm::normalize(glm::vec3(0.4f, -0.7f, 0.55f));

glm::vec3 texture_of(const SunMap& map, glm::vec3 world) {
    return glm::vec3(map.world_to_texture * glm::vec4(world, 1));
}

TEST(SunCascades, EndsFollowThePracticalSplitScheme) {
    const auto uniform = cascade_ends(1, 81, 0);
    const auto logarithmic = cascade_ends(1, 81, 1);
    const auto mixed = cascade_ends(1, 81, 0.25f);
    for (int i = 0; i < SUN_CASCADES; ++i) {
        EXPECT_NEAR(uniform[i], 1 + 20 * (i + 1), 1e-3);
        EXPECT_NEAR(logarithmic[i], std::pow(3.0, i + 1), 1e-3);
        EXPECT_NEAR(mixed[i], 0.75 * uniform[i] + 0.25 * logarithmic[i], 1e-3);
    }
}

TEST(SunCascades, BasisIsARotationWithItsLastRowTowardsTheSun) {
    for (const glm::vec3 direction : {sun_direction, glm::vec3(0, -1, 0), glm::vec3(0, 1, 0), glm::vec3(3, 0, 0)}) {
        const glm::mat3 basis = sun_basis(direction);
        EXPECT_NEAR(glm::determinant(basis), 1, 1e-5);
        const glm::vec3 to_sun = basis * -glm::normalize(direction);
        EXPECT_NEAR(glm::distance(to_sun, glm::vec3(0, 0, 1)), 0, 1e-5);
    }
}

// The sphere must touch or hold each corner of the slice, and be no larger than the farthest of them needs.
TEST(SunCascades, SliceSphereIsTheSmallestRoundTheCorners) {
    for (const auto [yfov, aspect, begin, end] :
         {std::array{1.0f, 1.78f, 0.1f, 5.0f}, {0.4f, 1.0f, 5.0f, 40.0f}, {2.2f, 2.4f, 20.0f, 80.0f}}) {
        const auto [center, radius] = slice_sphere(yfov, aspect, begin, end);
        const auto farthest = [&](float c) {
            float most = 0;
            for (const float depth : {begin, end}) {
                const float y = depth * std::tan(yfov / 2);
                most = std::max(most, glm::length(glm::vec3(y * aspect, y, depth - c)));
            }
            return most;
        };
        EXPECT_NEAR(farthest(center), radius, 1e-4f * radius);
        for (float c = 0; c < 2 * end; c += end / 64) EXPECT_GE(farthest(c), radius * 0.9999f) << c;
    }
}

TEST(SunCascades, MapHoldsItsWholeSliceWithARimForTheFilter) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> u(-1, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const glm::vec3 eye = 500.0f * glm::vec3(u(random), u(random), u(random));
        const View view = look_at(eye, eye + glm::vec3(u(random), u(random), u(random)), 1.0f, 0.1f, 1.78f);
        const glm::vec3 direction(u(random), -1, u(random));
        const SunMap map = fit_cascade(view, 4, 20, direction, cascade_size);
        const glm::mat4 inverse_view = glm::inverse(view.view);
        for (int i = 0; i < 50; ++i) {
            const float depth = 12 + 8 * u(random);
            const float y = depth * std::tan(0.5f);
            const glm::vec3 local(u(random) * y * 1.78f, u(random) * y, -depth);
            const glm::vec3 p = texture_of(map, glm::vec3(inverse_view * glm::vec4(local, 1)));
            const float rim = 1.5f / map_size;
            ASSERT_TRUE(p.x > rim && p.x < 1 - rim && p.y > rim && p.y < 1 - rim) << p.x << ' ' << p.y;
            ASSERT_TRUE(p.z > 0 && p.z < 1) << p.z;
        }
    }
}

TEST(SunCascades, DepthIsGreaterNearerToTheSun) {
    const View view = look_at({0, 2, 0}, {3, 1, -4}, 1.0f, 0.1f, 1.5f);
    const SunMap map = fit_cascade(view, 0.1f, 20, sun_direction, cascade_size);
    const glm::vec3 a = texture_of(map, {1, 1, -2});
    const glm::vec3 b = texture_of(map, glm::vec3(1, 1, -2) - sun_direction);
    EXPECT_GT(b.z, a.z);
    EXPECT_NEAR(a.x, b.x, 1e-5);
    EXPECT_NEAR(a.y, b.y, 1e-5);
}

TEST(SunCascades, TexelIsTheWorldSizeOfATexel) {
    const View view = look_at({0, 2, 0}, {3, 1, -4}, 1.0f, 0.1f, 1.5f);
    const SunMap map = fit_cascade(view, 0.1f, 20, sun_direction, cascade_size);
    const glm::vec3 right = glm::transpose(sun_basis(sun_direction))[0];
    const glm::vec3 step = texture_of(map, right * map.texel) - texture_of(map, glm::vec3(0));
    EXPECT_NEAR(step.x * map_size, 1, 1e-3);
}

// What shimmers is a texel grid that moves over the world: the place within its texel of a fixed point must not
// change, however the camera moves or turns.
TEST(SunCascades, TexelGridStaysFixedWhenTheCameraMovesAndTurns) {
    const glm::vec3 point(3.1f, 0.7f, -6.3f);
    const auto place_in_texel = [&](const View& view) {
        return glm::fract(glm::vec2(texture_of(fit_cascade(view, 2, 12, sun_direction, cascade_size), point)) *
                          float(map_size));
    };
    const glm::vec2 first = place_in_texel(look_at({0, 1.7f, 0}, {0, 1.7f, -10}, 1.0f, 0.1f, 1.78f));
    for (int i = 1; i < 300; ++i) {
        const float t = static_cast<float>(i);
        const glm::vec3 eye(0.0037f * t, 1.7f + 0.001f * t, -0.0051f * t);
        const glm::vec3 target =
            eye + glm::vec3(std::sin(0.01f * t), 0.1f * std::sin(0.03f * t), -std::cos(0.01f * t));
        const glm::vec2 now = place_in_texel(look_at(eye, target, 1.0f, 0.1f, 1.78f));
        const glm::vec2 moved = glm::abs(now - first);
        EXPECT_LT(std::min(moved.x, 1 - moved.x), 2e-3f) << i;
        EXPECT_LT(std::min(moved.y, 1 - moved.y), 2e-3f) << i;
    }
}

TEST(SunCascades, MatrixStaysTheSameForASixteenthOfTheMap) {
    const auto map = [&](float x) {
        const View view = look_at({x, 1.7f, 0}, {x, 1.7f, -10}, 1.0f, 0.1f, 1.78f);
        return fit_cascade(view, 20, 80, sun_direction, cascade_size);
    };
    const float sixteenth = cascade_size / 16 * map(0).texel;
    int changes = 0;
    for (int i = 0; i < 400; ++i)
        changes += map(0.01f * sixteenth * float(i)).world_to_texture !=
                   map(0.01f * sixteenth * float(i + 1)).world_to_texture;
    EXPECT_GE(changes, 2);
    EXPECT_LE(changes, 12) << "four sixteenths in steps of a hundredth of one, three axes";
}

TEST(SunCascades, StaticMapHoldsTheBounds) {
    const Aabb bounds{{-30, -2, 10}, {50, 25, 90}};
    const SunMap map = fit_static(bounds, sun_direction, 2048);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p =
            texture_of(map, {corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                             corner & 4 ? bounds.max.z : bounds.min.z});
        EXPECT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1);
    }
    const SunMap none = fit_static(Aabb{}, sun_direction, 2048);
    EXPECT_TRUE(std::isfinite(none.texel) && none.texel > 0);
}

TEST(SunCascades, CasterVolumeReachesTowardsTheSunOnly) {
    const View view = look_at({0, 2, 0}, {0, 2, -4}, 1.0f, 0.1f, 1.5f);
    const SunMap map = fit_cascade(view, 0.1f, 10, sun_direction, cascade_size);
    const Frustum volume = caster_volume(map);
    const glm::vec3 inside = view.eye + glm::vec3(0, 0, -5);
    EXPECT_TRUE(volume.intersects_sphere(inside, 0.01f));
    EXPECT_TRUE(volume.intersects_sphere(inside - 1000.0f * sun_direction, 0.01f));
    EXPECT_FALSE(volume.intersects_sphere(inside + 1000.0f * sun_direction, 0.01f));
    EXPECT_FALSE(volume.intersects_sphere(inside + glm::vec3(1000, 0, 0), 0.01f));
}

}  // namespace
}  // namespace tyndall
