#pragma once

#include <memory>
#include <string>

#include "engine/gl/framebuffer.h"
#include "engine/platform/gl_context.h"
#include "sample_game/ui/imgui_renderer.h"

struct ImGuiContext;

namespace tyndall {

/// What the window shows until the first frame: the name of the game, what is being done, and a bar. It has a Dear
/// ImGui context of its own and must be gone before another is made.
class LoadingPicture {
  public:
    LoadingPicture(GlContext& context, ShaderLibrary& shaders);
    ~LoadingPicture();
    LoadingPicture(const LoadingPicture&) = delete;
    LoadingPicture& operator=(const LoadingPicture&) = delete;

    /// Takes the window's events, draws and presents. `share` of the work that is done, 0 to 1.
    void show(const std::string& doing, float share);
    [[nodiscard]] const gl::Texture& picture() const { return picture_; }
    /// All that were pressed meanwhile.
    [[nodiscard]] decltype(Input::keys_pressed) keys_pressed() const { return keys_pressed_; }

  private:
    struct ContextDeleter {
        void operator()(ImGuiContext* context) const;
    };
    GlContext& context_;
    std::unique_ptr<ImGuiContext, ContextDeleter> imgui_;
    std::unique_ptr<ImguiRenderer> renderer_;
    gl::Texture picture_;
    gl::Framebuffer framebuffer_;
    decltype(Input::keys_pressed) keys_pressed_;
};

}  // namespace tyndall
