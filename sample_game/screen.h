#pragma once

#include <glm/vec2.hpp>

#include "engine/core/image.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/render/renderer.h"

namespace tyndall {

/// What the window shows: the renderer's picture, or where that is smaller than the window, the same with smoothed
/// outlines and scaled up. The UI is drawn over it.
class Screen {
  public:
    explicit Screen(ShaderLibrary& shaders);
    /// Takes the picture of the last frame. `window` in pixels.
    void show(const Renderer& renderer, glm::ivec2 window);

    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
    [[nodiscard]] Image read() const;  ///< as Renderer::read_display

  private:
    struct Target {
        gl::Texture texture;
        gl::Framebuffer framebuffer;
        void resize(glm::ivec2 size, const char* label);
    };
    ShaderLibrary& shaders_;
    gl::Sampler linear_;
    Target smooth_, scaled_;
    gl::TextureView picture_;
    GLuint framebuffer_ = 0;
    glm::ivec2 size_{0};
};

}  // namespace tyndall
