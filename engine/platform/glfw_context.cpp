#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <cstdlib>
#include <optional>

#include "engine/core/error.h"
#include "engine/platform/backends.h"
#include "engine/platform/glfw_input.h"

namespace tyndall {
namespace {

std::string glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "unknown reason" : text;
}

/// GLFW itself, initialised while at least one window exists.
class GlfwLibrary {
  public:
    GlfwLibrary() {
        if (users_ == 0 && glfwInit() == GLFW_FALSE) {
            const std::string reason = glfw_error();
            const char* display = std::getenv("DISPLAY");
            if (display == nullptr || *display == '\0') {
                throw Error("no display: set DISPLAY or use tyndall render");
            }
            throw Error(fmt::format("no display: {} (DISPLAY={}); use tyndall render", reason, display));
        }
        ++users_;
    }
    ~GlfwLibrary() {
        if (--users_ == 0) glfwTerminate();
    }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;

  private:
    static inline int users_ = 0;
};

class GlfwContext final : public GlContext {
  public:
    explicit GlfwContext(const ContextRequest& request) : vsync_(request.vsync) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        create_window(request);
        if (window_ == nullptr) {  // any version, so that `initialise` can say which one the driver has
            glfwDefaultWindowHints();
            create_window(request);
        }
        if (window_ == nullptr) throw Error(fmt::format("no GLFW window: {}", glfw_error()));
        glfw_input_.emplace(window_, input_);
    }
    ~GlfwContext() override {
        release();
        if (window_ != nullptr) glfwDestroyWindow(window_);
    }
    void open(bool debug) {
        initialise(glfwGetProcAddress, debug);
        glfwSwapInterval(vsync_ ? 1 : 0);
    }

    [[nodiscard]] ContextKind kind() const override { return ContextKind::glfw; }
    void poll() override { glfw_input_->poll(); }
    void capture_pointer(bool capture) override { glfw_input_->capture_pointer(capture); }
    [[nodiscard]] bool should_close() const override { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
    void request_close() override { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
    void show_window(glm::ivec2 size) override {
        glfwSetWindowSize(window_, size.x, size.y);
        glfwShowWindow(window_);
    }
    void set_full_screen(bool full) override {
        if (full == (glfwGetWindowMonitor(window_) != nullptr)) return;
        GLFWmonitor* monitor = glfwGetPrimaryMonitor();
        const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
        if (full && mode != nullptr) {
            glfwGetWindowPos(window_, &place_.x, &place_.y);
            glfwGetWindowSize(window_, &size_.x, &size_.y);
            glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
        } else if (!full) {
            glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, size_.x, size_.y, GLFW_DONT_CARE);
        }
    }
    [[nodiscard]] glm::ivec2 framebuffer_size() const override {
        glm::ivec2 size;
        glfwGetFramebufferSize(window_, &size.x, &size.y);
        return size;
    }
    void present(unsigned framebuffer, glm::ivec2 size) override {
        const glm::ivec2 window = framebuffer_size();
        glDisable(GL_SCISSOR_TEST);  // it would clip the blit
        glBlitNamedFramebuffer(framebuffer, 0, 0, 0, size.x, size.y, 0, 0, window.x, window.y, GL_COLOR_BUFFER_BIT,
                               size == window ? GL_NEAREST : GL_LINEAR);
        glfwSwapBuffers(window_);
    }

  protected:
    void bind() override { glfwMakeContextCurrent(window_); }
    void unbind() override { glfwMakeContextCurrent(nullptr); }

  private:
    void create_window(const ContextRequest& request) {
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, request.debug ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        window_ = glfwCreateWindow(request.size.x, request.size.y, request.title.c_str(), nullptr, nullptr);
    }

    GlfwLibrary library_;
    GLFWwindow* window_ = nullptr;
    std::optional<GlfwInput> glfw_input_;
    bool vsync_;
    glm::ivec2 place_{0}, size_{0};  // of the window before it filled the monitor
};

}  // namespace

std::unique_ptr<GlContext> create_glfw_context(const ContextRequest& request) {
    auto context = std::make_unique<GlfwContext>(request);
    context->open(request.debug);
    return context;
}

}  // namespace tyndall
