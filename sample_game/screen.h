#pragma once

#include <glm/vec2.hpp>

#include "engine/core/image.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/texture.h"
#include "engine/render/renderer.h"

namespace tyndall {

/// What the window shows: the renderer's picture, scaled up where it is smaller than the window. The UI is drawn
/// over it.
class Screen {
  public:
    /// Takes the picture of the last frame. `window` in pixels.
    void show(const Renderer& renderer, glm::ivec2 window);

    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
    [[nodiscard]] Image read() const;  ///< as Renderer::read_display

  private:
    gl::Texture scaled_;
    gl::Framebuffer scaled_framebuffer_;
    gl::TextureView picture_;
    GLuint framebuffer_ = 0;
    glm::ivec2 size_{0};
};

}  // namespace tyndall
