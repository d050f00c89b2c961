#pragma once

#include <bitset>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// The keys the game and the debug UI know, independent of the window library.
enum class Key {
    a,
    b,
    c,
    d,
    e,
    f,
    g,
    h,
    i,
    j,
    k,
    l,
    m,
    n,
    o,
    p,
    q,
    r,
    s,
    t,
    u,
    v,
    w,
    x,
    y,
    z,
    num_0,
    num_1,
    num_2,
    num_3,
    num_4,
    num_5,
    num_6,
    num_7,
    num_8,
    num_9,
    space,
    enter,
    escape,
    tab,
    backspace,
    del,
    home,
    end,
    page_up,
    page_down,
    left,
    right,
    up,
    down,
    shift,
    control,
    alt,
    minus,
    period,
    comma,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    count
};
/// Of all keys, in their order: "a", "0", "page_up", "f1".
[[nodiscard]] const std::vector<std::string>& key_names();

enum class MouseButton { left, right, middle, count };

/// Input since the last poll. "pressed" is the edge, "down" the level.
struct Input {
    std::bitset<static_cast<int>(Key::count)> keys_down, keys_pressed;
    std::bitset<static_cast<int>(MouseButton::count)> buttons_down, buttons_pressed;
    /// Shift, control and alt as they were at the latest press of a button or, without one, of a key since the last
    /// poll: in a slow frame they may have come and gone with it.
    struct Modifiers {
        bool shift = false, control = false, alt = false;
    };
    std::optional<Modifiers> press_modifiers;
    glm::dvec2 pointer{0};        ///< window pixels from the top left
    glm::dvec2 pointer_delta{0};  ///< since the last poll
    double scroll = 0;
    std::string text;  ///< UTF-8 typed since the last poll
    struct Gamepad {
        bool present = false;
        glm::vec2 left{0}, right{0};  ///< sticks, -1..1, +y is down (GLFW), dead zone removed
        /// Pressed edges of A, Y, Start, X and B.
        bool jump = false, fly = false, menu = false, use = false, lantern = false;
        float up = 0, down = 0;  ///< triggers 0..1
        struct Menu {
            bool up = false, down = false, left = false, right = false, accept = false, back = false;
        } held;  ///< directional pad, A and B
    } gamepad;

    [[nodiscard]] bool down(Key k) const { return keys_down[static_cast<int>(k)]; }
    [[nodiscard]] bool pressed(Key k) const { return keys_pressed[static_cast<int>(k)]; }
    /// Forgets edges and deltas: back ends call it at the start of a poll.
    void begin_poll();
    /// Those of `press_modifiers`, else the keys that are down.
    [[nodiscard]] Modifiers modifiers() const;
};

/// A stick's position with the inner `radius` (a worn stick's rest) cut away; the rest is stretched back to 0..1.
[[nodiscard]] glm::vec2 remove_dead_zone(glm::vec2 stick, float radius = 0.15f);

}  // namespace tyndall
