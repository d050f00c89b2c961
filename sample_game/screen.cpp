#include "sample_game/screen.h"

#include "engine/gl/readback.h"

namespace tyndall {

void Screen::show(const Renderer& renderer, glm::ivec2 window) {
    size_ = window;
    framebuffer_ = renderer.display_framebuffer();
    picture_ = renderer.display();
    const glm::ivec2 from = renderer.size();
    if (from == window) return;
    if (!scaled_ || scaled_.size() != window) {
        scaled_ = gl::Texture({gl::TextureKind::d2, GL_RGBA8, {window, 1}, 1}, "screen");
        const gl::Attachment attachment{scaled_};
        scaled_framebuffer_ = gl::Framebuffer(std::span(&attachment, 1), nullptr, "screen");
    }
    glDisable(GL_SCISSOR_TEST);  // it would clip the blit
    glBlitNamedFramebuffer(framebuffer_, scaled_framebuffer_.id(), 0, 0, from.x, from.y, 0, 0, window.x, window.y,
                           GL_COLOR_BUFFER_BIT, GL_LINEAR);
    framebuffer_ = scaled_framebuffer_.id();
    picture_ = scaled_;
}

Image Screen::read() const {
    return gl::read_texture(picture_);
}

}  // namespace tyndall
