#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/scene/scene.h"

namespace tyndall {
namespace {

using Interpolation = Animation::Interpolation;
using Path = Animation::Path;

constexpr float half_pi = std::numbers::pi_v<float> / 2;

Scene scene_of(Animation::Channel channel, const std::string& name = "move") {
    Scene scene;
    scene.nodes.emplace_back();
    Animation animation;
    animation.name = name;
    animation.duration = channel.times.back();
    animation.channels.push_back(std::move(channel));
    scene.animations.push_back(animation);
    return scene;
}

glm::vec4 xyzw(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

float x_at(Scene& scene, double time) {
    animate_one(scene, scene.animations[0], time);
    return scene.nodes[0].translation.x;
}

/// Angle between two rotations, rad.
float angle_between(const glm::quat& a, const glm::quat& b) {
    const glm::quat difference = glm::inverse(a) * b;
    return 2 * std::atan2(glm::length(glm::vec3(difference.x, difference.y, difference.z)), std::abs(difference.w));
}

TEST(Animation, StepHoldsTheKeyBefore) {
    Scene scene = scene_of(
        {0, Path::translation, Interpolation::step, {1, 2, 4}, {{10, 0, 0, 0}, {20, 0, 0, 0}, {30, 0, 0, 0}}});
    EXPECT_EQ(x_at(scene, 0), 10);
    EXPECT_EQ(x_at(scene, 1.99), 10);
    EXPECT_EQ(x_at(scene, 2), 20);
    EXPECT_EQ(x_at(scene, 3.9), 20);
    EXPECT_EQ(x_at(scene, 4), 30);
}

TEST(Animation, LinearIsClampedOutsideItsKeys) {
    Scene scene = scene_of({0, Path::translation, Interpolation::linear, {1, 3}, {{10, 0, 0, 0}, {20, 0, 0, 0}}});
    EXPECT_FLOAT_EQ(x_at(scene, 0.5), 10);
    EXPECT_FLOAT_EQ(x_at(scene, 1.5), 12.5f);
    EXPECT_FLOAT_EQ(x_at(scene, 3), 20);
    EXPECT_FLOAT_EQ(x_at(scene, 99), 20);
    EXPECT_FLOAT_EQ(x_at(scene, -1), 10);
}

TEST(Animation, CubicByHand) {
    // v0 = 0, out-tangent 1, in-tangent -2, v1 = 3, 2 s apart, at u = 1/4: the Hermite weights are 0.84375,
    // 0.140625, 0.15625, -0.046875, so 2 * 0.140625 * 1 + 0.15625 * 3 + 2 * -0.046875 * -2 = 0.9375.
    Scene scene = scene_of({0,
                            Path::translation,
                            Interpolation::cubic,
                            {1, 3},
                            {{9, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {-2, 0, 0, 0}, {3, 0, 0, 0}, {9, 0, 0, 0}}});
    EXPECT_NEAR(x_at(scene, 1.5), 0.9375f, 1e-6f);
    EXPECT_EQ(x_at(scene, 1), 0);
    EXPECT_EQ(x_at(scene, 3), 3);
}

TEST(Animation, CubicReproducesAnyCubic) {
    const auto f = [](float t) { return 2 * t * t * t - 3 * t * t + t - 5; };
    const auto slope = [](float t) { return 6 * t * t - 6 * t + 1; };
    Animation::Channel channel{0, Path::translation, Interpolation::cubic, {0, 0.5f, 2}, {}};
    for (const float t : channel.times)
        for (const float v : {slope(t), f(t), slope(t)}) channel.values.emplace_back(v, 0, 0, 0);
    Scene scene = scene_of(channel);
    for (float t = 0; t <= 2; t += 0.125f) EXPECT_NEAR(x_at(scene, t), f(t), 2e-5f) << t;
}

TEST(Animation, RotationTakesTheShorterArcAtConstantSpeed) {
    const glm::quat end = glm::angleAxis(half_pi, glm::vec3(0, 1, 0));
    Scene scene = scene_of({0, Path::rotation, Interpolation::linear, {0, 1}, {{0, 0, 0, 1}, -xyzw(end)}});
    for (const float t : {0.0f, 0.1f, 0.25f, 0.5f, 0.9f, 1.0f}) {
        animate_one(scene, scene.animations[0], t);
        EXPECT_NEAR(angle_between(scene.nodes[0].rotation, glm::angleAxis(t * half_pi, glm::vec3(0, 1, 0))), 0,
                    1e-5f);
    }
}

TEST(Animation, RotationsThatHardlyDifferStayUnitQuaternions) {
    const glm::quat end = glm::angleAxis(1e-4f, glm::vec3(1, 0, 0));
    Scene scene = scene_of({0, Path::rotation, Interpolation::linear, {0, 1}, {{0, 0, 0, 1}, xyzw(end)}});
    animate_one(scene, scene.animations[0], 0.5);
    EXPECT_NEAR(glm::length(scene.nodes[0].rotation), 1, 1e-6f);
    EXPECT_NEAR(scene.nodes[0].rotation.x, std::sin(0.25e-4f), 1e-9f);
}

TEST(Animation, CubicRotationIsNormalisedEvenWhereItPassesZero) {
    Scene scene =
        scene_of({0, Path::rotation, Interpolation::cubic, {0, 1}, {{}, {0, 0, 0, 1}, {}, {}, {0, 0, 0, -1}, {}}});
    for (const float t : {0.2f, 0.5f, 0.7f}) {
        animate_one(scene, scene.animations[0], t);
        EXPECT_NEAR(glm::length(scene.nodes[0].rotation), 1, 1e-6f) << t;
    }
}

TEST(Animation, LoopsForwardsAndBackwards) {
    Scene scene = scene_of({0, Path::translation, Interpolation::linear, {0, 2}, {{0, 0, 0, 0}, {8, 0, 0, 0}}});
    for (const auto& [time, x] : {std::pair(0.5, 2.0f), {2.5, 2.0f}, {2000.5, 2.0f}, {-0.5, 6.0f}}) {
        animate(scene, time);
        EXPECT_NEAR(scene.nodes[0].translation.x, x, 1e-4f) << time;
    }
}

TEST(Animation, TheExceptedAnimationDoesNotMove) {
    Scene scene =
        scene_of({0, Path::scale, Interpolation::linear, {0, 2}, {{1, 1, 1, 0}, {8, 8, 8, 0}}}, "flythrough");
    animate(scene, 1);
    EXPECT_EQ(scene.nodes[0].scale, glm::vec3(1));
    animate(scene, 1, "");
    EXPECT_EQ(scene.nodes[0].scale, glm::vec3(4.5f));
}

TEST(Animation, ChildrenFollowAndTransformsAreTranslationRotationScale) {
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].translation = {1, 0, 0};
    scene.nodes[0].rotation = glm::angleAxis(half_pi, glm::vec3(0, 0, 1));
    scene.nodes[0].scale = {2, 1, 1};
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {3, 0, 0};
    update_world_transforms(scene);
    // (1, 0, 0) in the child is (4, 0, 0) in the parent, (8, 0, 0) scaled, (0, 8, 0) turned, (1, 8, 0) moved.
    const glm::vec4 p = scene.nodes[1].world * glm::vec4(1, 0, 0, 1);
    EXPECT_NEAR(glm::distance(glm::vec3(p), glm::vec3(1, 8, 0)), 0, 1e-5f);
}

TEST(Scene, WhatIsMissingFramesTheBounds) {
    Scene scene;
    scene.bounds = {{-1, 2, -3}, {5, 4, 3}};
    scene.exposure_ev100 = 3;
    add_missing_camera(scene);
    EXPECT_TRUE(scene.lights.empty());
    add_missing_sun(scene);
    ASSERT_EQ(scene.cameras.size(), 1u);
    ASSERT_EQ(scene.lights.size(), 1u);
    ASSERT_TRUE(scene.sun());
    const glm::mat4 to_camera = glm::inverse(scene.nodes[static_cast<std::size_t>(scene.cameras[0].node)].world);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) != 0 ? -1 : 5, (corner & 2) != 0 ? 2 : 4, (corner & 4) != 0 ? -3 : 3);
        const glm::vec3 seen(to_camera * glm::vec4(p, 1));
        EXPECT_LT(seen.z, -scene.cameras[0].znear);
        EXPECT_LT(std::abs(seen.y / seen.z), std::tan(scene.cameras[0].yfov / 2));
        EXPECT_LT(std::abs(seen.x / seen.z), std::tan(scene.cameras[0].yfov / 2));
    }
    add_missing_camera(scene);
    add_missing_sun(scene);
    EXPECT_EQ(scene.cameras.size() + scene.lights.size(), 2u);
}

}  // namespace
}  // namespace tyndall
