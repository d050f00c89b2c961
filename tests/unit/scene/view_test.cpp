#include "engine/scene/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace tyndall {
namespace {

constexpr float yfov = 1.1f, aspect = 1.6f, znear = 0.25f;

glm::vec3 random_vector(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> u(-size, size);
    const float x = u(random), y = u(random), z = u(random);
    return {x, y, z};
}

View random_view(std::mt19937& random) {
    return look_at(random_vector(random, 5), random_vector(random, 5), yfov, znear, aspect);
}

/// Clip-space definition of what a reversed, infinite projection shows; `slack` widens (or narrows) it.
bool visible(const View& view, glm::vec3 p, float slack = 0) {
    const glm::vec4 c = view.view_projection * glm::vec4(p, 1);
    return std::abs(c.x) <= c.w + slack && std::abs(c.y) <= c.w + slack && c.z <= c.w + slack;
}

TEST(View, DepthIsNearOverDistance) {
    const glm::mat4 p = reversed_infinite_projection(yfov, aspect, znear);
    for (const float distance : {0.25f, 0.5f, 1.0f, 100.0f, 1e7f}) {
        const glm::vec4 clip = p * glm::vec4(0.3f, -0.2f, -distance, 1);
        EXPECT_NEAR(clip.z / clip.w, 0.25f / distance, 1e-7f) << distance;
    }
}

TEST(View, EdgesOfThePictureFollowTheFieldOfView) {
    const glm::mat4 p = reversed_infinite_projection(yfov, aspect, znear);
    const float top = 7 * std::tan(yfov / 2);
    const glm::vec4 corner = p * glm::vec4(top * aspect, top, -7, 1);
    EXPECT_NEAR(corner.x / corner.w, 1, 1e-6f);
    EXPECT_NEAR(corner.y / corner.w, 1, 1e-6f);
}

TEST(View, ScaleOfTheCameraNodeDoesNotMatter) {
    const glm::mat4 pose =
        glm::translate(glm::mat4(1), glm::vec3(1, 2, 3)) * glm::rotate(glm::mat4(1), 0.7f, glm::vec3(0, 1, 0));
    const View plain = make_view(pose, yfov, znear, aspect);
    const View scaled = make_view(glm::scale(pose, glm::vec3(3)), yfov, znear, aspect);
    // A rotation by +0.7 about y turns -Z towards -X.
    const glm::vec3 ahead = glm::vec3(1, 2, 3) + 5.0f * glm::vec3(-std::sin(0.7f), 0, -std::cos(0.7f));
    for (const View& view : {plain, scaled}) {
        const glm::vec3 seen(view.view * glm::vec4(ahead, 1));
        EXPECT_NEAR(glm::distance(seen, glm::vec3(0, 0, -5)), 0, 1e-5f);
        EXPECT_EQ(view.eye, glm::vec3(1, 2, 3));
    }
}

TEST(View, LooksStraightUpAndDownAndAtItself) {
    for (const glm::vec3 target : {glm::vec3(0, -3, 0), glm::vec3(0, 9, 0), glm::vec3(0)}) {
        const View view = look_at(glm::vec3(0), target, yfov, znear, aspect);
        const glm::vec3 expected = target == glm::vec3(0) ? glm::vec3(0, 0, -1) : glm::normalize(target);
        const glm::vec3 seen(view.view * glm::vec4(expected, 1));
        EXPECT_NEAR(glm::distance(seen, glm::vec3(0, 0, -1)), 0, 1e-6f);
    }
}

TEST(Frustum, LeavesOutAnInfiniteFarPlaneOnly) {
    std::mt19937 random(1);
    EXPECT_EQ(Frustum::from(random_view(random).view_projection).count, 5);
    EXPECT_EQ(Frustum::from(glm::ortho(-2.0f, 2.0f, -1.0f, 1.0f, 0.1f, 50.0f)).count, 6);
    EXPECT_EQ(Frustum::from(glm::perspective(1.0f, 1.5f, 0.1f, 1000.0f)).count, 6);
}

TEST(Frustum, PointsAgreeWithClipSpace) {
    std::mt19937 random(2);
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
        const View view = random_view(random);
        const glm::vec3 p = random_vector(random, 10);
        if (visible(view, p, 1e-4f) != visible(view, p, -1e-4f)) continue;  // on a plane
        const bool expected = visible(view, p);
        inside += expected ? 1 : 0;
        const Frustum frustum = Frustum::from(view.view_projection);
        ASSERT_EQ(frustum.intersects({p, p}), expected);
        ASSERT_EQ(frustum.intersects_sphere(p, 0), expected);
    }
    EXPECT_GT(inside, 2000);
}

TEST(Frustum, NeverRejectsABoxOrSphereThatIsVisibleAndSeldomAcceptsOthers) {
    std::mt19937 random(3);
    int hidden_boxes = 0, kept_boxes = 0;
    for (int i = 0; i < 3000; ++i) {
        const View view = random_view(random);
        const Frustum frustum = Frustum::from(view.view_projection);
        const glm::vec3 center = random_vector(random, 10), half = glm::abs(random_vector(random, 2));
        bool box_seen = false, sphere_seen = false;
        for (int k = 0; k < 1000; ++k) {
            const glm::vec3 unit = (glm::vec3(k % 10, k / 10 % 10, k / 100) / 4.5f) - 1.0f;
            const glm::vec3 p = center + half * unit;
            if (!visible(view, p)) continue;
            box_seen = true;
            sphere_seen |= glm::distance(p, center) <= half.x;
        }
        const bool box_kept = frustum.intersects({center - half, center + half});
        ASSERT_TRUE(box_kept || !box_seen);
        ASSERT_TRUE(frustum.intersects_sphere(center, half.x) || !sphere_seen);
        hidden_boxes += box_seen ? 0 : 1;
        kept_boxes += !box_seen && box_kept ? 1 : 0;
    }
    EXPECT_GT(hidden_boxes, 1000);
    EXPECT_LT(kept_boxes, hidden_boxes / 5);
}

TEST(Frustum, ASphereTouchesWhereItsRadiusReachesThePlane) {
    const View view = look_at(glm::vec3(0), glm::vec3(0, 0, -1), yfov, znear, aspect);
    const Frustum frustum = Frustum::from(view.view_projection);
    const glm::vec3 behind(0, 0, 2);  // 2.25 m behind the near plane
    EXPECT_TRUE(frustum.intersects_sphere(behind, 2.26f));
    EXPECT_FALSE(frustum.intersects_sphere(behind, 2.24f));
    EXPECT_TRUE(frustum.intersects_sphere(glm::vec3(0, 0, -1e6f), 1));
}

TEST(View, LooksWhereItShouldFarFromTheOrigin) {
    const glm::vec3 forward = glm::normalize(glm::vec3(0.31f, -0.4f, -0.87f));
    for (const float far : {0.0f, 1e3f, 1e6f, 1e9f}) {
        const glm::vec3 eye = far * glm::vec3(0.6f, 0.3f, 0.74f);
        const glm::mat4 pose =
            glm::translate(glm::mat4(1), eye) * glm::mat4_cast(glm::quatLookAt(forward, {0, 1, 0}));
        const View view = make_view(pose, 1, 0.1f, 1);
        const glm::vec3 seen = glm::mat3(view.view) * forward;
        EXPECT_NEAR(glm::distance(seen, glm::vec3(0, 0, -1)), 0, 1e-6f) << far;
    }
}

TEST(Frustum, AnEmptyBoxIsNowhere) {
    std::mt19937 random(4);
    EXPECT_FALSE(Frustum::from(random_view(random).view_projection).intersects(Aabb{}));
}

TEST(Aabb, TransformedIsTheBoxOfTheTransformedCorners) {
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 center = random_vector(random, 3), half = glm::abs(random_vector(random, 2));
        glm::mat4 m(1);
        for (int c = 0; c < 4; ++c) m[c] = glm::vec4(random_vector(random, 2), c == 3 ? 1 : 0);
        Aabb expected;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 sign((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
            expected.add(glm::vec3(m * glm::vec4(center + sign * half, 1)));
        }
        const Aabb box = transformed({center - half, center + half}, m);
        EXPECT_NEAR(glm::distance(box.min, expected.min), 0, 1e-5f);
        EXPECT_NEAR(glm::distance(box.max, expected.max), 0, 1e-5f);
    }
    EXPECT_TRUE(transformed(Aabb{}, glm::mat4(2)).empty());
}

}  // namespace
}  // namespace tyndall
