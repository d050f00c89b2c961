// The walk of the sample level, on foot, from the first dark lamp to the last picture: every place in the script's
// order, and what then burns in the scene.
#include <gtest/gtest.h>

#include <algorithm>

#include "sample_game/walk/walk_scene.h"
#include "support/command.h"
#include "support/walker.h"

namespace tyndall::test {
namespace {

constexpr double dt = 1.0 / 20;

/// x and z of a way past all lamps.
constexpr glm::vec2 way[] = {{90.5f, -1.5f},  {60, 0},         {30, 0},          {9, 0},          {0.5f, 0},
                             {-8.6f, 0},      {-12.9f, 2.6f},  {-20, 2.8f},      {-27, 2.6f},     {-20, 2.8f},
                             {-12.9f, 2.6f},  {-13.75f, 6},    {-13.75f, 10.3f}, {-14.5f, 11.2f}, {-17.4f, 11.3f},
                             {-20.5f, 11.1f}, {-22.4f, 11.7f}, {-22.4f, 14.2f},  {-19, 17.4f},    {-7, 24},
                             {-1, 22.1f},     {1.9f, 22.1f},   {4.8f, 25},       {1.9f, 22.1f},   {-1, 22.1f},
                             {-11, 24.4f},    {-30, 16.6f},    {-37.4f, 15.2f},  {-38.6f, 24.5f}, {-38.6f, 38},
                             {-38.4f, 57.5f}, {-38.8f, 63.5f}, {-44.5f, 68.6f},  {-51, 69.9f}};

std::ptrdiff_t dark_lamps(const Scene& scene) {
    return std::ranges::count_if(scene.lights, [](const Light& l) { return l.intensity == glm::vec3(0); });
}

class LevelWalk : public ::testing::Test {
  protected:
    LevelWalk() { animate(scene_, 0); }
    void frame(Input input, bool use) {
        const bool fell = player_.update(input, dt, true);
        EXPECT_FALSE(fell) << "out of the level";
        walk_.update({.eye = player_.eye(), .direction = player_.direction(), .use = use}, dt);
        time_ += dt;
    }
    void go_to(glm::vec3 target) {
        int patience = 0;
        for (float nearest = 1e9f; ground_distance(player_.eye(), target) > 0.7f;) {
            Input input = towards(player_, target);
            input.keys_down[static_cast<std::size_t>(Key::shift)] = true;
            frame(input, true);
            const float distance = ground_distance(player_.eye(), target);
            patience = distance < nearest - 0.01f ? 0 : patience + 1;
            nearest = std::min(nearest, distance);
            ASSERT_LT(patience, 60) << "stuck at " << player_.eye().x << ", " << player_.eye().y << ", "
                                    << player_.eye().z << " on the way to " << target.x << ", " << target.z;
        }
    }
    template <class Done>
    void stand_until(Done done) {
        const double begun = time_;
        while (!done() && time_ < begun + 120) frame({}, false);
        EXPECT_TRUE(done());
    }
    Scene scene_ = load_gltf(level());
    const std::vector<Light> own_ = scene_.lights;
    WalkScene lights_{load_walk(walk_path(level())), scene_, "walk"};
    Player player_{scene_};
    Walk walk_{lights_.script()};
    double time_ = 0;
};

TEST_F(LevelWalk, IsWalkedToItsEnd) {
    const auto apply = [&] { lights_.apply(scene_, walk_, player_.camera_to_world(), time_); };
    apply();
    EXPECT_EQ(scene_.lights.size(), own_.size() + 1) << "and the lantern";
    EXPECT_GE(dark_lamps(scene_), 270) << "all but the sun, the tower's and one at each place";
    walk_.update({.eye = player_.eye(), .lantern = true}, dt);
    apply();
    EXPECT_GT(scene_.lights.back().intensity.r, 0);
    const glm::vec3 lantern(scene_.nodes[static_cast<std::size_t>(scene_.lights.back().node)].world[3]);
    EXPECT_LT(glm::distance(lantern, player_.eye()), 1);
    std::size_t lit = 0;
    for (const glm::vec2 at : way) {
        go_to({at.x, 0, at.y});
        if (HasFatalFailure()) return;
        EXPECT_LE(walk_.lit(), lit + 1);
        EXPECT_TRUE(walk_.lit() == lit || walk_.burning(lit)) << "in the order of the hints";
        lit = walk_.lit();
    }
    ASSERT_EQ(lit, lights_.script().places.size());
    EXPECT_LT(time_, 180) << "running";
    stand_until([&] { return walk_.ending(); });
    apply();
    EXPECT_EQ(dark_lamps(scene_), 1) << "the lantern";
    stand_until([&] { return walk_.over(); });

    lights_.restore(scene_);
    for (std::size_t i = 0; i < own_.size(); ++i) EXPECT_EQ(scene_.lights[i].intensity, own_[i].intensity);
}

TEST_F(LevelWalk, WhatGlowsIsDarkBeforeItsLampIsLit) {
    const auto shown = [&](bool dark) {
        return std::ranges::count_if(scene_.nodes, [&](const Node& node) {
            return !node.cast_shadow && node.scale == glm::vec3(1) && !node.meshes.empty() &&
                   std::ranges::any_of(node.meshes, [&](int mesh) {
                       const int m = scene_.meshes[static_cast<std::size_t>(mesh)].material;
                       return scene_.materials[static_cast<std::size_t>(m)].emissive != glm::vec3(0);
                   }) != dark;
        });
    };
    EXPECT_EQ(shown(true), 0);
    const auto glowing = shown(false);
    EXPECT_GT(glowing, 250);
    lights_.apply(scene_, walk_, player_.camera_to_world(), 0);
    EXPECT_LT(shown(false), 10) << "the tower's, and the first lamp of each place";
    lights_.restore(scene_);
    EXPECT_EQ(shown(false), glowing);
}

}  // namespace
}  // namespace tyndall::test
