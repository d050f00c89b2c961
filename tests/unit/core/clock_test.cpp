#include <gtest/gtest.h>

#include <thread>

#include "engine/platform/frame_clock.h"
#include "engine/platform/input.h"

namespace tyndall {
namespace {

TEST(FrameClock, FixedStepsDoNotDependOnTheWall) {
    FrameClock clock = FrameClock::fixed(0.25);
    EXPECT_EQ(clock.time(), 0);
    for (int frame = 1; frame <= 8; ++frame) {
        EXPECT_EQ(clock.tick(), 0.25);
        EXPECT_EQ(clock.time(), 0.25 * frame);
    }
}

TEST(FrameClock, SlowFramesKeepTheirTimeAndPausesAreCut) {
    FrameClock clock = FrameClock::wall();
    EXPECT_EQ(clock.tick(), 0) << "the first frame has no predecessor";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const double step = clock.tick();
    EXPECT_GE(step, 0.02);
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    const double slow = clock.tick();
    EXPECT_GE(slow, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(2050));
    EXPECT_EQ(clock.tick(), 2);
    EXPECT_DOUBLE_EQ(clock.time(), step + slow + 2);
}

TEST(Input, BeginPollForgetsEdgesAndKeepsLevels) {
    Input input;
    input.keys_down.set();
    input.keys_pressed.set();
    input.buttons_down.set();
    input.buttons_pressed.set();
    input.pointer = {3, 4};
    input.pointer_delta = {1, 2};
    input.scroll = 1;
    input.text = "x";
    input.press_modifiers = Input::Modifiers{true, true, true};
    input.gamepad = {true, {1, 0}, {0, 1}, true, true, true, true, true, 1, 1, {}};
    input.begin_poll();
    EXPECT_TRUE(input.down(Key::a));
    EXPECT_FALSE(input.pressed(Key::a));
    EXPECT_TRUE(input.buttons_down.all());
    EXPECT_TRUE(input.buttons_pressed.none());
    EXPECT_FALSE(input.press_modifiers);
    EXPECT_EQ(input.pointer, glm::dvec2(3, 4));
    EXPECT_EQ(input.pointer_delta, glm::dvec2(0));
    EXPECT_EQ(input.scroll, 0);
    EXPECT_EQ(input.text, "");
    EXPECT_FALSE(input.gamepad.jump || input.gamepad.fly || input.gamepad.menu || input.gamepad.use ||
                 input.gamepad.lantern);
    EXPECT_TRUE(input.gamepad.present);
    EXPECT_EQ(input.gamepad.left, glm::vec2(1, 0));
}

TEST(Input, EveryKeyHasAName) {
    ASSERT_EQ(key_names().size(), static_cast<std::size_t>(Key::count));
    EXPECT_EQ(key_names().at(static_cast<std::size_t>(Key::num_0)), "0");
    EXPECT_EQ(key_names().at(static_cast<std::size_t>(Key::page_up)), "page_up");
    EXPECT_EQ(key_names().at(static_cast<std::size_t>(Key::comma)), "comma");
    EXPECT_EQ(key_names().back(), "f12");
}

TEST(Input, ModifiersAreThoseOfThePress) {
    Input input;
    input.keys_down[static_cast<std::size_t>(Key::control)] = true;
    EXPECT_TRUE(input.modifiers().control);
    input.press_modifiers = Input::Modifiers{true, false, false};
    EXPECT_TRUE(input.modifiers().shift);
    EXPECT_FALSE(input.modifiers().control);
}

TEST(Input, DeadZoneIsCutAndTheRestStretched) {
    EXPECT_EQ(remove_dead_zone({0, 0}, 0.2f), glm::vec2(0));
    EXPECT_EQ(remove_dead_zone({0.1f, 0.1f}, 0.2f), glm::vec2(0));
    EXPECT_FLOAT_EQ(remove_dead_zone({0.6f, 0}, 0.2f).x, 0.5f);
    EXPECT_FLOAT_EQ(remove_dead_zone({0, -1}, 0.2f).y, -1);
    const glm::vec2 corner = remove_dead_zone({1, 1}, 0.2f);  // square sticks reach over the circle
    EXPECT_NEAR(corner.x, 0.70710678f, 1e-6);
    EXPECT_NEAR(corner.y, 0.70710678f, 1e-6);
}

}  // namespace
}  // namespace tyndall
