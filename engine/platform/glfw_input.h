#pragma once

#include "engine/platform/input.h"

struct GLFWwindow;

namespace tyndall {

/// Turns the events of one GLFW window into an `Input`. Takes the window's user pointer and input callbacks.
class GlfwInput {
  public:
    GlfwInput(GLFWwindow* window, Input& input);
    GlfwInput(const GlfwInput&) = delete;
    GlfwInput& operator=(const GlfwInput&) = delete;

    void poll();
    void capture_pointer(bool capture);

  private:
    static GlfwInput& of(GLFWwindow* window);
    void on_key(int glfw_key, int action, int modifiers);
    void on_button(int glfw_button, int action, int modifiers);
    void poll_gamepad();

    GLFWwindow* window_;
    Input& input_;
    struct {
        bool jump = false, fly = false, menu = false, use = false, lantern = false;
    } gamepad_down_;
    bool pointer_changed_hands_ = false;  ///< captured or freed since the last poll: it was moved to its place
};

}  // namespace tyndall
