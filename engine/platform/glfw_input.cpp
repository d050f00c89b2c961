#include "engine/platform/glfw_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr std::pair<int, Key> named_keys[] = {{GLFW_KEY_SPACE, Key::space},
                                              {GLFW_KEY_ENTER, Key::enter},
                                              {GLFW_KEY_KP_ENTER, Key::enter},
                                              {GLFW_KEY_ESCAPE, Key::escape},
                                              {GLFW_KEY_TAB, Key::tab},
                                              {GLFW_KEY_BACKSPACE, Key::backspace},
                                              {GLFW_KEY_DELETE, Key::del},
                                              {GLFW_KEY_HOME, Key::home},
                                              {GLFW_KEY_END, Key::end},
                                              {GLFW_KEY_PAGE_UP, Key::page_up},
                                              {GLFW_KEY_PAGE_DOWN, Key::page_down},
                                              {GLFW_KEY_LEFT, Key::left},
                                              {GLFW_KEY_RIGHT, Key::right},
                                              {GLFW_KEY_UP, Key::up},
                                              {GLFW_KEY_DOWN, Key::down},
                                              {GLFW_KEY_LEFT_SHIFT, Key::shift},
                                              {GLFW_KEY_RIGHT_SHIFT, Key::shift},
                                              {GLFW_KEY_LEFT_CONTROL, Key::control},
                                              {GLFW_KEY_RIGHT_CONTROL, Key::control},
                                              {GLFW_KEY_LEFT_ALT, Key::alt},
                                              {GLFW_KEY_RIGHT_ALT, Key::alt},
                                              {GLFW_KEY_MINUS, Key::minus},
                                              {GLFW_KEY_KP_SUBTRACT, Key::minus},
                                              {GLFW_KEY_PERIOD, Key::period},
                                              {GLFW_KEY_KP_DECIMAL, Key::period},
                                              {GLFW_KEY_COMMA, Key::comma}};

/// Letters, digits and function keys are consecutive in both enumerations.
Key to_key(int glfw_key) {
    const auto offset = [&](Key first, int glfw_first) {
        return static_cast<Key>(static_cast<int>(first) + glfw_key - glfw_first);
    };
    if (glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z) return offset(Key::a, GLFW_KEY_A);
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return offset(Key::num_0, GLFW_KEY_0);
    if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9) return offset(Key::num_0, GLFW_KEY_KP_0);
    if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12) return offset(Key::f1, GLFW_KEY_F1);
    const auto* found = std::ranges::find(named_keys, glfw_key, &std::pair<int, Key>::first);
    return found == std::end(named_keys) ? Key::count : found->second;
}

Input::Modifiers to_modifiers(int glfw_modifiers) {
    const auto held = [&](int bit) { return (glfw_modifiers & bit) != 0; };
    return {held(GLFW_MOD_SHIFT), held(GLFW_MOD_CONTROL), held(GLFW_MOD_ALT)};
}

void append_utf8(std::string& text, unsigned codepoint) {
    const auto byte = [&](unsigned prefix, unsigned shift) {
        text += static_cast<char>(prefix | ((codepoint >> shift) & 0x3F));
    };
    if (codepoint < 0x80) {
        text += static_cast<char>(codepoint);
    } else if (codepoint < 0x800) {
        text += static_cast<char>(0xC0 | (codepoint >> 6));
        byte(0x80, 0);
    } else if (codepoint < 0x10000) {
        text += static_cast<char>(0xE0 | (codepoint >> 12));
        byte(0x80, 6);
        byte(0x80, 0);
    } else {
        text += static_cast<char>(0xF0 | (codepoint >> 18));
        byte(0x80, 12);
        byte(0x80, 6);
        byte(0x80, 0);
    }
}

}  // namespace

GlfwInput::GlfwInput(GLFWwindow* window, Input& input) : window_(window), input_(input) {
    glfwSetWindowUserPointer(window, this);
    glfwGetCursorPos(window, &input.pointer.x, &input.pointer.y);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        of(w).on_key(key, action, modifiers);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
        of(w).on_button(button, action, modifiers);
    });
    glfwSetCharCallback(window,
                        [](GLFWwindow* w, unsigned codepoint) { append_utf8(of(w).input_.text, codepoint); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).input_.scroll += y; });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        Input& input = of(w).input_;
        input.pointer_delta += glm::dvec2(x, y) - input.pointer;
        input.pointer = {x, y};
    });
}

GlfwInput& GlfwInput::of(GLFWwindow* window) {
    return *static_cast<GlfwInput*>(glfwGetWindowUserPointer(window));
}

void GlfwInput::on_key(int glfw_key, int action, int modifiers) {
    const Key key = to_key(glfw_key);
    if (key == Key::count || action == GLFW_REPEAT) return;
    const auto index = static_cast<std::size_t>(key);
    if (action == GLFW_PRESS) {
        input_.keys_pressed[index] = !input_.keys_down[index] || input_.keys_pressed[index];
        const bool is_modifier = key == Key::shift || key == Key::control || key == Key::alt;
        if (!is_modifier && input_.buttons_pressed.none()) input_.press_modifiers = to_modifiers(modifiers);
    }
    input_.keys_down[index] = action == GLFW_PRESS;
    for (const auto& [other, mapped] : named_keys) {  // the left one may still be held when the right one goes up
        if (mapped == key && glfwGetKey(window_, other) == GLFW_PRESS) input_.keys_down[index] = true;
    }
}

void GlfwInput::on_button(int glfw_button, int action, int modifiers) {
    static_assert(GLFW_MOUSE_BUTTON_LEFT == int(MouseButton::left) &&
                  GLFW_MOUSE_BUTTON_RIGHT == int(MouseButton::right) &&
                  GLFW_MOUSE_BUTTON_MIDDLE == int(MouseButton::middle));
    if (glfw_button >= static_cast<int>(MouseButton::count)) return;
    const auto index = static_cast<std::size_t>(glfw_button);
    input_.buttons_down[index] = action == GLFW_PRESS;
    if (action != GLFW_PRESS) return;
    input_.buttons_pressed[index] = true;
    input_.press_modifiers = to_modifiers(modifiers);
}

void GlfwInput::poll() {
    input_.begin_poll();
    glfwPollEvents();
    if (std::exchange(pointer_changed_hands_, false)) input_.pointer_delta = glm::dvec2(0);
    poll_gamepad();
}

void GlfwInput::poll_gamepad() {
    Input::Gamepad& pad = input_.gamepad;
    GLFWgamepadstate state;
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        if (glfwGetGamepadState(joystick, &state) == GLFW_FALSE) continue;
        const auto edge = [&](int button, bool& down) {
            return state.buttons[button] == GLFW_PRESS && !std::exchange(down, state.buttons[button] == GLFW_PRESS);
        };
        const auto axis = [&](int index) { return state.axes[index]; };
        pad.present = true;
        pad.left = remove_dead_zone({axis(GLFW_GAMEPAD_AXIS_LEFT_X), axis(GLFW_GAMEPAD_AXIS_LEFT_Y)});
        pad.right = remove_dead_zone({axis(GLFW_GAMEPAD_AXIS_RIGHT_X), axis(GLFW_GAMEPAD_AXIS_RIGHT_Y)});
        pad.jump = edge(GLFW_GAMEPAD_BUTTON_A, gamepad_down_.jump);
        pad.fly = edge(GLFW_GAMEPAD_BUTTON_Y, gamepad_down_.fly);
        pad.menu = edge(GLFW_GAMEPAD_BUTTON_START, gamepad_down_.menu);
        pad.use = edge(GLFW_GAMEPAD_BUTTON_X, gamepad_down_.use);
        pad.lantern = edge(GLFW_GAMEPAD_BUTTON_B, gamepad_down_.lantern);
        const auto held = [&](int button) { return state.buttons[button] == GLFW_PRESS; };
        pad.held = {.up = held(GLFW_GAMEPAD_BUTTON_DPAD_UP),
                    .down = held(GLFW_GAMEPAD_BUTTON_DPAD_DOWN),
                    .left = held(GLFW_GAMEPAD_BUTTON_DPAD_LEFT),
                    .right = held(GLFW_GAMEPAD_BUTTON_DPAD_RIGHT),
                    .accept = held(GLFW_GAMEPAD_BUTTON_A),
                    .back = held(GLFW_GAMEPAD_BUTTON_B)};
        pad.up = (axis(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER) + 1) / 2;
        pad.down = (axis(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER) + 1) / 2;
        return;
    }
    pad = {};
    gamepad_down_ = {};
}

void GlfwInput::capture_pointer(bool capture) {
    glfwSetInputMode(window_, GLFW_CURSOR, capture ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported() == GLFW_TRUE) {
        glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, capture ? GLFW_TRUE : GLFW_FALSE);
    }
    glfwGetCursorPos(window_, &input_.pointer.x, &input_.pointer.y);  // the change itself is no motion
    input_.pointer_delta = glm::dvec2(0);
    pointer_changed_hands_ = true;
}

}  // namespace tyndall
