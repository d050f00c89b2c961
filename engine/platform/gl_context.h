#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "engine/platform/input.h"

namespace tyndall {

/// automatic: GLFW if a window is asked for; else EGL, else OSMesa (each failure is logged).
enum class ContextKind { automatic, egl, osmesa, glfw };

struct ContextRequest {
    ContextKind kind = ContextKind::automatic;
    glm::ivec2 size{1280, 720};  ///< what framebuffer_size() says at first
    std::string title = "Tyndall";
    bool window = false;  ///< a window is wanted: it is hidden until show_window()
    bool vsync = true;
    bool debug = true;  ///< GL_DEBUG_OUTPUT, synchronous; messages go to the log and to `debug_messages`
};

/// What the renderer may want to know of the driver.
struct Capabilities {
    std::string vendor, renderer, version;
    bool software = false;             ///< gl::is_software_driver: timer queries lie, see gl::TimerMode
    bool indirect_parameters = false;  ///< ARB_indirect_parameters
    float max_anisotropy = 1;
    int max_texture_size = 0;
};

/// An OpenGL 4.5 core context. The renderer always draws to its own framebuffers; `present` is a blit. GL's
/// lower-left origin holds everywhere and clip depth is 0..1 (glClipControl), as reversed depth needs. Several may
/// exist, all on one thread, and one is current; GL objects are freed while theirs is.
class GlContext {
  public:
    using Loader = void (*(*)(const char* name))();  ///< a GetProcAddress

    virtual ~GlContext();
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Releases the context that is current, makes this one current and loads its functions.
    void make_current();
    [[nodiscard]] virtual ContextKind kind() const = 0;
    /// Takes pending window events into `input()`. Headless: does nothing.
    virtual void poll() {}
    /// Shows colour attachment 0 of `framebuffer` (size in pixels). Headless: glFinish.
    virtual void present(unsigned framebuffer, glm::ivec2 size) = 0;
    [[nodiscard]] virtual bool should_close() const { return false; }
    virtual void request_close() {}
    /// Gives the window that size in pixels and shows it. Headless: framebuffer_size() says it from now on.
    virtual void show_window(glm::ivec2 size) = 0;
    /// Pixels of the window's framebuffer; the requested size when headless.
    [[nodiscard]] virtual glm::ivec2 framebuffer_size() const = 0;
    /// The window fills its monitor, or has the size and place again that it had before. Headless: does nothing.
    virtual void set_full_screen(bool) {}
    /// Captures the pointer for mouse look. Headless: does nothing.
    virtual void capture_pointer(bool) {}
    [[nodiscard]] const Capabilities& capabilities() const { return capabilities_; }
    [[nodiscard]] Input& input() { return input_; }

  protected:
    virtual void bind() = 0;
    virtual void unbind() = 0;
    /// Makes current, checks for 4.5 core, fills capabilities_, hooks debug output. Called by each back end when
    /// its context exists. Throws Error.
    void initialise(Loader loader, bool debug);
    /// Called by the destructor of each back end before its context goes.
    void release();
    Capabilities capabilities_;
    Input input_;

  private:
    Loader loader_ = nullptr;
};

/// Makes a context current. Throws Error: which kind failed and why ("no display", "OpenGL 3.3, 4.5 needed").
[[nodiscard]] std::unique_ptr<GlContext> create_context(const ContextRequest& request);
[[nodiscard]] ContextKind parse_context_kind(const std::string& name);  ///< throws UsageError
[[nodiscard]] const char* to_string(ContextKind kind);

/// GL debug messages of medium or high severity since the start (or the last reset): tests require 0.
struct DebugMessages {
    int count = 0;
    std::string last;
};
[[nodiscard]] DebugMessages debug_messages();
void reset_debug_messages();

}  // namespace tyndall
