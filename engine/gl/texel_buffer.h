#pragma once

#include "engine/gl/buffer.h"

namespace tyndall::gl {

/// A list of structs of vec4 that shaders read as the texels of a readonly imageBuffer (rgba32f). Software
/// rasterisers read a storage buffer lane by lane where each lane has its own index, and texels of all lanes at
/// once.
class TexelBuffer {
  public:
    /// Writes all of `data`, growing the buffer when it does not fit. Throws Error beyond what the driver allows.
    template <class T>
    void assign(std::span<const T> data, const std::string& label) {
        static_assert(sizeof(T) % 16 == 0);
        buffer_.assign(data, label);
        view(label);
    }
    void bind(GLuint image_unit) const;
    [[nodiscard]] GLuint id() const { return buffer_.id(); }  ///< of the buffer
    explicit operator bool() const { return static_cast<bool>(buffer_); }

  private:
    void view(const std::string& label);
    struct Traits {
        static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    };
    Buffer buffer_;
    Handle<Traits> texels_;
    GLuint viewed_ = 0;  ///< the buffer that the texels are of
};

}  // namespace tyndall::gl
