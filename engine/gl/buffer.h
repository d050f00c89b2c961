#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "engine/gl/handle.h"

namespace tyndall::gl {

/// Immutable-storage buffer that the CPU may update with `write` (GL_DYNAMIC_STORAGE_BIT).
class Buffer {
  public:
    Buffer() = default;
    Buffer(std::size_t bytes, const std::string& label, const void* data = nullptr);

    template <class T>
    static Buffer of(std::span<const T> data, const std::string& label) {
        return Buffer(data.size_bytes(), label, data.data());
    }

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }
    [[nodiscard]] std::size_t size() const { return bytes_; }

    void write(std::size_t offset, std::size_t bytes, const void* data);
    /// Writes all of `data` at 0, growing (re-creating, never shrinking) the buffer when it does not fit.
    template <class T>
    void assign(std::span<const T> data, const std::string& label) {
        assign_bytes(data.data(), data.size_bytes(), label);
    }
    void read(std::size_t offset, std::size_t bytes, void* out) const;  ///< waits for the GPU
    void clear_uint(GLuint value);
    void bind(GLenum target, GLuint index) const;  ///< GL_UNIFORM_BUFFER or GL_SHADER_STORAGE_BUFFER

  private:
    void assign_bytes(const void* data, std::size_t bytes, const std::string& label);
    struct Traits {
        static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
    };
    Handle<Traits> handle_;
    std::size_t bytes_ = 0;
};

}  // namespace tyndall::gl
