#include "engine/platform/input.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace tyndall {

void Input::begin_poll() {
    keys_pressed.reset();
    buttons_pressed.reset();
    press_modifiers.reset();
    pointer_delta = glm::dvec2(0);
    scroll = 0;
    text.clear();
    gamepad.jump = gamepad.fly = gamepad.menu = false;
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
