#pragma once

#include <glad/gl.h>

#include <utility>

namespace tyndall::gl {

/// Owns one GL name; moves, never copies. `Traits::destroy(GLuint)` deletes it.
template <class Traits>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~Handle() {
        if (id_ != 0) Traits::destroy(id_);
    }
    [[nodiscard]] GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

  private:
    GLuint id_ = 0;
};

}  // namespace tyndall::gl
