#include "engine/platform/input.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace tyndall {

const std::vector<std::string>& key_names() {
    static const std::vector<std::string> names{
        "a",         "b",       "c",    "d",     "e",       "f",         "g",     "h",     "i",      "j",
        "k",         "l",       "m",    "n",     "o",       "p",         "q",     "r",     "s",      "t",
        "u",         "v",       "w",    "x",     "y",       "z",         "0",     "1",     "2",      "3",
        "4",         "5",       "6",    "7",     "8",       "9",         "space", "enter", "escape", "tab",
        "backspace", "del",     "home", "end",   "page_up", "page_down", "left",  "right", "up",     "down",
        "shift",     "control", "alt",  "minus", "period",  "comma",     "f1",    "f2",    "f3",     "f4",
        "f5",        "f6",      "f7",   "f8",    "f9",      "f10",       "f11",   "f12"};
    return names;
}

void Input::begin_poll() {
    keys_pressed.reset();
    buttons_pressed.reset();
    press_modifiers.reset();
    pointer_delta = glm::dvec2(0);
    scroll = 0;
    text.clear();
    gamepad.jump = gamepad.fly = gamepad.menu = gamepad.use = gamepad.lantern = false;
}

Input::Modifiers Input::modifiers() const {
    return press_modifiers.value_or(Modifiers{down(Key::shift), down(Key::control), down(Key::alt)});
}

glm::vec2 remove_dead_zone(glm::vec2 stick, float radius) {
    const float length = glm::length(stick);
    if (length <= radius) return glm::vec2(0);
    return stick / length * std::min((length - radius) / (1 - radius), 1.0f);
}

}  // namespace tyndall
