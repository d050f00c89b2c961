// The walker on small floors, walls, stairs and slopes whose right answers are plain geometry. No display needed.
#include "sample_game/player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace tyndall {
namespace {

constexpr float eye_height = 1.65f;

/// A scene of boxes, with a player_start at the origin that looks along -Z.
class BoxScene {
  public:
    BoxScene() {
        scene_.materials.emplace_back();
        scene_.nodes.emplace_back().name = "player_start";
    }
    BoxScene& box(glm::vec3 low, glm::vec3 high, bool animated = false) {
        Mesh mesh;
        for (int i = 0; i < 8; ++i) {
            Vertex v{};
            v.position = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                          (i & 4) != 0 ? high.z : low.z};
            mesh.vertices.push_back(v);
            scene_.bounds.add(v.position);
        }
        mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                        2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
        add(std::move(mesh), animated);
        return *this;
    }
    BoxScene& surroundings(glm::vec3 low, glm::vec3 high) {
        box(low, high);
        scene_.nodes.back().name = "terrain";
        return *this;
    }
    /// A plane that rises towards -Z from (0, 0, z) by `degrees`, 20 m long.
    BoxScene& slope(float z, float degrees) {
        const float rise = 20 * std::sin(glm::radians(degrees)), run = 20 * std::cos(glm::radians(degrees));
        Mesh mesh;
        for (const glm::vec3 p :
             {glm::vec3(-5, 0, z), glm::vec3(5, 0, z), glm::vec3(5, rise, z - run), glm::vec3(-5, rise, z - run)}) {
            Vertex v{};
            v.position = p;
            mesh.vertices.push_back(v);
            scene_.bounds.add(p);
        }
        mesh.indices = {0, 1, 2, 0, 2, 3};
        add(std::move(mesh), false);
        return *this;
    }
    BoxScene& floor() { return box({-50, -1, -50}, {50, 0, 50}); }
    [[nodiscard]] const Scene& scene() const { return scene_; }

  private:
    void add(Mesh mesh, bool animated) {
        Node& node = scene_.nodes.emplace_back();
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        node.dynamic = animated;
        scene_.meshes.push_back(std::move(mesh));
    }
    Scene scene_;
};

Input holding(std::initializer_list<Key> keys) {
    Input input;
    for (const Key k : keys) input.keys_down[static_cast<std::size_t>(k)] = true;
    return input;
}

Input pressing(Key key) {
    Input input = holding({key});
    input.keys_pressed[static_cast<std::size_t>(key)] = true;
    return input;
}

/// Runs `seconds` in steps of `dt`; `each` sees every frame.
void run(
    Player& player, const Input& input, double seconds, double dt = 1.0 / 60,
    const std::function<void()>& each = [] {}) {
    for (double t = 0; t < seconds - dt / 2; t += dt) {
        player.update(input, dt, false);
        each();
    }
}

TEST(Player, StandsAtEyeHeightWithoutTrembling) {
    Player player(BoxScene().floor().scene());
    run(player, {}, 1);
    EXPECT_TRUE(player.on_ground());
    EXPECT_NEAR(player.eye().y, eye_height, 0.06);
    const glm::vec3 rest = player.eye();
    run(player, {}, 2, 1.0 / 50, [&] { EXPECT_LT(glm::length(player.eye() - rest), 1e-3f); });
}

TEST(Player, WalksAtTheSameSpeedAtEveryFrameRate) {
    for (const double rate : {0.5, 1.0, 5.0, 20.0, 30.0, 60.0, 144.0}) {
        Player player(BoxScene().floor().scene());
        run(player, {}, 0.5);
        const glm::vec3 from = player.eye();
        run(player, holding({Key::w}), 2, 1 / rate);
        const glm::vec3 way = player.eye() - from;
        EXPECT_NEAR(-way.z, 4.8, 0.1) << rate;
        EXPECT_NEAR(way.x, 0, 0.01) << rate;
        EXPECT_NEAR(way.y, 0, 0.01) << rate;
    }
}

TEST(Player, MovesInProportionToFramesOfUnequalLength) {
    Player player(BoxScene().floor().scene());
    run(player, {}, 0.5);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> length(1.0 / 60, 1.0 / 20);
    glm::vec3 last = player.eye();
    for (int i = 0; i < 100; ++i) {
        const double dt = length(random);
        player.update(holding({Key::w}), dt, false);
        EXPECT_NEAR((last.z - player.eye().z) / dt, 2.4, 0.12) << i;
        EXPECT_NEAR(player.eye().y, last.y, 2e-3) << i;
        last = player.eye();
    }
}

TEST(Player, SlowFramesLeadWhereFastOnesDo) {
    // Round a corner of a wall and down a step, for 12 s, with a stick that turns.
    const auto end = [](double dt) {
        Player player(BoxScene().floor().box({-3, 0, -6}, {3, 2, -5}).box({-9, 0, -20}, {9, 0.2f, -2}).scene());
        run(player, {}, 2);
        Input input = holding({Key::w, Key::shift});
        input.gamepad.right = {0.1f, 0};
        run(player, input, 12, dt);
        return player.eye();
    };
    const glm::vec3 fast = end(1.0 / 60);
    EXPECT_GT(glm::length(fast - glm::vec3(0, eye_height, 0)), 8.0f);
    for (const double dt : {1.0 / 10, 0.5, 1.0, 2.0})
        EXPECT_LT(glm::length(end(dt) - fast), 0.05f) << dt << " s a frame";
    EXPECT_EQ(end(1), end(1));
}

TEST(Player, FliesEquallyFarAtEveryFrameRateAndRoundTheSameCurve) {
    const auto end = [](double dt) {
        Player player(BoxScene().floor().scene());
        player.set_flying(true);
        Input input = holding({Key::w});
        input.gamepad.right = {0.3f, 0};
        run(player, input, 4, dt);
        return player.eye();
    };
    EXPECT_LT(glm::length(end(1) - end(1.0 / 60)), 0.05f);
}

TEST(Player, AGamepadWalksAndRuns) {
    Player player(BoxScene().floor().scene());
    run(player, {}, 0.5);
    glm::vec3 from = player.eye();
    Input input;
    input.gamepad.left = {0, -1};
    run(player, input, 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 2.4, 0.1);
    from = player.eye();
    input.gamepad.up = 1;
    run(player, input, 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 5.0, 0.15);
}

TEST(Player, WalksByItsOwnKeys) {
    Player player(BoxScene().floor().scene());
    player.keys.forward = Key::i;
    run(player, {}, 0.5);
    const glm::vec3 from = player.eye();
    run(player, holding({Key::w}), 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 0, 0.01);
    run(player, holding({Key::i}), 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 2.4, 0.1);
}

TEST(Player, ShiftRunsAndDiagonalsAreNotFaster) {
    Player player(BoxScene().floor().scene());
    run(player, {}, 0.5);
    glm::vec3 from = player.eye();
    run(player, holding({Key::w, Key::shift}), 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 5.0, 0.15);
    from = player.eye();
    run(player, holding({Key::w, Key::d}), 1);
    EXPECT_NEAR(glm::length(player.eye() - from), 2.4, 0.1);
}

TEST(Player, AWallStopsItAndLetsItSlide) {
    Player player(BoxScene().floor().box({-50, 0, -4}, {50, 4, -3.9f}).scene());
    run(player, {}, 0.5);
    run(player, holding({Key::w, Key::shift}), 3, 1.0 / 20);
    EXPECT_LT(player.eye().z, -3.0);
    EXPECT_GT(player.eye().z, -3.9 + 0.25);
    const glm::vec3 from = player.eye();
    run(player, holding({Key::w, Key::d}), 1, 1.0 / 20);
    EXPECT_GT(player.eye().x - from.x, 1.2);
    EXPECT_GT(player.eye().z, -3.9 + 0.25);
}

TEST(Player, WhatIsAnimatedIsNotSolid) {
    Player player(BoxScene().floor().box({-50, 0, -4}, {50, 4, -3.9f}, true).scene());
    run(player, holding({Key::w, Key::shift}), 2);
    EXPECT_LT(player.eye().z, -6);
}

TEST(Player, StairsAreARampToTheEye) {
    BoxScene scene;
    scene.floor();
    constexpr int steps = 12;
    constexpr float rise = 0.17f, tread = 0.3f;
    for (int i = 0; i < steps; ++i)
        scene.box({-3, 0, -20}, {3, rise * static_cast<float>(i + 1), -2 - tread * static_cast<float>(i)});
    for (const double dt : {1.0 / 20, 1.0 / 60}) {
        Player player(scene.scene());
        run(player, {}, 0.5);
        float last = player.eye().y;
        run(player, holding({Key::w}), 4, dt, [&] {
            const float up = player.eye().y - last;
            EXPECT_GT(up, -0.02f);
            EXPECT_LT(up, 4.2 * dt);  // m/s: the stair itself rises at 1.4
            last = player.eye().y;
        });
        EXPECT_NEAR(player.eye().y, eye_height + steps * rise, 0.08);
        float lowest_rate = 0;
        Input back = holding({Key::s});
        last = player.eye().y;
        run(player, back, 4, dt, [&] {
            lowest_rate = std::min(lowest_rate, (player.eye().y - last) / static_cast<float>(dt));
            last = player.eye().y;
        });
        EXPECT_NEAR(player.eye().y, eye_height, 0.08);
        EXPECT_GT(lowest_rate, -4.2f);
    }
}

TEST(Player, AHighKerbStopsAndALowOneDoesNot) {
    for (const float height : {0.2f, 0.6f}) {
        Player player(BoxScene().floor().box({-5, 0, -20}, {5, height, -2}).scene());
        run(player, {}, 0.5);
        run(player, holding({Key::w}), 2);
        const bool climbed = player.eye().z < -2.5;
        EXPECT_EQ(climbed, height < 0.3f) << height;
    }
}

TEST(Player, WalksUpAHillButNotUpACliff) {
    for (const float degrees : {25.0f, 40.0f, 70.0f}) {
        Player player(BoxScene().floor().slope(-2, degrees).scene());
        run(player, {}, 0.5);
        run(player, holding({Key::w}), 3);
        if (degrees < 50)
            EXPECT_GT(player.eye().y, eye_height + 1.5f) << degrees;
        else
            EXPECT_LT(player.eye().y, eye_height + 0.7f) << degrees;
    }
}

TEST(Player, JumpsAsHighAsItsSpeedSays) {
    for (const double dt : {1.0 / 20, 1.0 / 60}) {
        Player player(BoxScene().floor().scene());
        run(player, {}, 0.5);
        const float ground = player.eye().y;
        float top = ground;
        player.update(pressing(Key::space), dt, false);
        run(player, {}, 2, dt, [&] { top = std::max(top, player.eye().y); });
        EXPECT_NEAR(top - ground, 4.2 * 4.2 / (2 * 9.81), 0.08) << dt;  // v²/2g
        EXPECT_NEAR(player.eye().y, ground, 0.02);
        EXPECT_TRUE(player.on_ground());
    }
}

TEST(Player, DoesNotFallThroughAThinFloorOnSlowFrames) {
    Player player(BoxScene().box({-50, -0.02f, -50}, {50, 0, 50}).scene());
    player.place({0, 40, 0}, {0, 0, -1});
    run(player, {}, 6, 0.1);
    EXPECT_NEAR(player.eye().y, eye_height, 0.08);
    EXPECT_TRUE(player.on_ground());
}

TEST(Player, WhoLeavesTheWorldStartsAgain) {
    Player player(BoxScene().box({-3, -1, -3}, {3, 0, 3}).scene());
    run(player, {}, 0.5);
    bool again = false;
    for (int i = 0; i < 600 && !again; ++i) again = player.update(holding({Key::w, Key::shift}), 1.0 / 30, false);
    ASSERT_TRUE(again);
    EXPECT_NEAR(glm::length(player.eye() - glm::vec3(0, eye_height, 0)), 0, 0.1);
    EXPECT_NEAR(player.direction().z, -1, 1e-4);
}

TEST(Player, WhoWalksOutOfTheLevelOntoItsSurroundingsIsBackAtOnce) {
    BoxScene scene;
    scene.box({-3, -1, -3}, {3, 0, 3}).surroundings({-50, -3, -50}, {50, -1.7f, 50});
    Player player(scene.scene());
    run(player, {}, 0.5);
    int cuts = 0;
    for (int i = 0; i < 300; ++i) {
        cuts += player.update(holding({Key::w}), 1.0 / 30, false) ? 1 : 0;
        EXPECT_TRUE(!player.on_ground() || player.eye().y > 1.5f) << "never stands on the surroundings";
    }
    EXPECT_GE(cuts, 1);
    EXPECT_LT(std::abs(player.eye().z), 4);
    EXPECT_NEAR(player.direction().z, -1, 1e-4);

    player.set_flying(true);  // who comes flying may walk there
    player.place({0, 3, -20}, {0, 0, -1});
    player.set_flying(false);
    run(player, {}, 3);
    run(player, holding({Key::w}), 1);
    EXPECT_NEAR(player.eye().y, eye_height - 1.7f, 0.08);
    EXPECT_LT(player.eye().z, -22);
}

TEST(Player, FliesAlongItsViewThroughWalls) {
    Player player(BoxScene().floor().box({-50, 0, -4}, {50, 4, -3.9f}).scene());
    player.set_flying(true);
    player.place({0, 2, 0}, glm::normalize(glm::vec3(0, 1, -1)));
    run(player, holding({Key::w}), 1);
    EXPECT_NEAR(player.eye().y, 2 + 6 * std::sqrt(0.5), 0.1);
    EXPECT_NEAR(player.eye().z, -6 * std::sqrt(0.5), 0.1);
    player.set_flying(false);  // and falls
    run(player, {}, 3);
    EXPECT_NEAR(player.eye().y, eye_height, 0.08);
}

TEST(Player, ThePointerTurnsTheViewOnlyWhenItMay) {
    Player player(BoxScene().floor().scene());
    Input right;
    right.pointer_delta = {100, 0};
    player.update(right, 1.0 / 60, false);
    EXPECT_NEAR(player.direction().x, 0, 1e-5);
    player.update(right, 1.0 / 60, true);
    EXPECT_NEAR(std::atan2(player.direction().x, -player.direction().z), 0.22, 1e-3);
    Input up;
    up.pointer_delta = {0, -10000};
    player.update(up, 1.0 / 60, true);
    EXPECT_GT(player.direction().y, 0.99);  // no further than the zenith
    EXPECT_LT(player.direction().y, 1.0);
}

}  // namespace
}  // namespace tyndall
