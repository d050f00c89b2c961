#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/scene.h"

namespace tyndall {
namespace {

/// A chain of nodes by their scales and rotations; the last one's pose.
struct Step {
    glm::vec3 scale{1};
    glm::quat rotation{1, 0, 0, 0};
};
glm::mat4 pose_of(const std::vector<Step>& steps) {
    Scene scene;
    for (const Step& step : steps) {
        Node& node = scene.nodes.emplace_back();
        node.parent = static_cast<int>(scene.nodes.size()) - 2;
        node.scale = step.scale;
        node.rotation = step.rotation;
        node.translation = {1, 2, 3};
    }
    update_world_transforms(scene);
    return node_pose(scene, static_cast<int>(steps.size()) - 1);
}

void expect_axes(const glm::mat4& pose, glm::vec3 back, glm::vec3 up) {
    EXPECT_NEAR(glm::distance(glm::vec3(pose[2]), glm::normalize(back)), 0, 1e-4f);
    EXPECT_NEAR(glm::distance(glm::vec3(pose[1]), glm::normalize(up)), 0, 1e-4f);
    EXPECT_NEAR(glm::distance(glm::vec3(pose[0]), glm::cross(glm::vec3(pose[1]), glm::vec3(pose[2]))), 0, 1e-6f);
}

const glm::quat quarter_x = glm::angleAxis(std::acos(-1.0f) / 2, glm::vec3(1, 0, 0));
const glm::quat eighth_x = glm::angleAxis(std::acos(-1.0f) / 4, glm::vec3(1, 0, 0));

TEST(NodePose, ScaleDoesNotShowAndMirrorsTurnAxesOver) {
    expect_axes(pose_of({{{2, 3, 4}}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{glm::vec3(1e-25f)}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{{-1, 1, 1}}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{{1, -1, 1}}}), {0, 0, 1}, {0, -1, 0});
    expect_axes(pose_of({{{1, 1, -1}}}), {0, 0, -1}, {0, 1, 0});
    EXPECT_EQ(pose_of({{glm::vec3(3)}, {glm::vec3(0)}})[3], glm::vec4(4, 8, 12, 1));
}

TEST(NodePose, ShearLeavesTheDirectionAndTurnsUpwardsToIt) {
    // Turned by 45 degrees about x and then stretched by 3 along y: -Z of (0, -1, 1) goes to (0, -3, 1), +Y of
    // (0, 1, 1) to (0, 3, 1), which is orthogonal to the former as (0, 1, 3).
    expect_axes(pose_of({{{1, 3, 1}}, {glm::vec3(1), eighth_x}}), {0, -3, 1}, {0, 1, 3});
}

TEST(NodePose, OfScalesOfZeroIsTheLimitOfSmallOnes) {
    expect_axes(pose_of({{glm::vec3(0)}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{{1, 1, 0}}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{{1, 0, 1}}}), {0, 0, 1}, {0, 1, 0});
    // +Z turned to -Y, which its parent flattens.
    expect_axes(pose_of({{{1, 0, 1}}, {glm::vec3(1), quarter_x}}), {0, -1, 0}, {0, 0, 1});
    // Both turned into the one direction that is left.
    expect_axes(pose_of({{{1, 0, 1}}, {glm::vec3(1), eighth_x}}), {0, 0, 1}, {0, 1, 0});
    expect_axes(pose_of({{{0, 0, 0}}, {{1, 1, 0}, quarter_x}, {glm::vec3(0)}}), {0, -1, 0}, {0, 0, 1});
}

TEST(Mirrors, ByAnOddNumberOfNegativeScalesAndNotByFlatness) {
    for (int signs = 0; signs < 8; ++signs) {
        const glm::vec3 scale(signs & 1 ? -1e-12f : 2, signs & 2 ? -1 : 1, signs & 4 ? -1e9f : 1e9f);
        EXPECT_EQ(mirrors(glm::scale(glm::mat4_cast(eighth_x), scale)), std::popcount(unsigned(signs)) % 2 == 1);
    }
    for (const glm::quat& turn : {quarter_x, eighth_x, glm::normalize(glm::quat(1, 2, 3, 4))}) {
        const glm::mat4 flat = glm::scale(glm::mat4(1), glm::vec3(1, 0, 1)) * glm::mat4_cast(turn);
        EXPECT_FALSE(mirrors(flat));
        EXPECT_FALSE(mirrors(glm::mat4_cast(turn) * flat));
    }
}

}  // namespace
}  // namespace tyndall
