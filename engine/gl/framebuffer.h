#pragma once

#include <glm/vec2.hpp>
#include <initializer_list>
#include <span>
#include <string>

#include "engine/gl/texture.h"

namespace tyndall::gl {

/// One attachment: a level, and a layer where `layer` >= 0 (otherwise the whole texture, layered).
struct Attachment {
    TextureView texture;
    int level = 0;
    int layer = -1;
};

class Framebuffer {
  public:
    Framebuffer() = default;
    /// Colour attachments in order; `depth` may be empty. Throws Error if incomplete, naming the label.
    Framebuffer(std::span<const Attachment> color, const Attachment* depth, const std::string& label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    void bind() const;  ///< as the draw framebuffer, with the viewport of its whole size

  private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
    };
    Handle<Traits> handle_;
    glm::ivec2 size_{0};
};

}  // namespace tyndall::gl
