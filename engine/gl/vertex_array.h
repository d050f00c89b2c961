#pragma once

#include <string>

#include "engine/gl/handle.h"

namespace tyndall::gl {

class VertexArray {
  public:
    VertexArray() = default;
    explicit VertexArray(const std::string& label);
    [[nodiscard]] GLuint id() const { return handle_.id(); }

    /// `binding` gets `buffer` with `stride`; instance data has divisor 1.
    void vertex_buffer(GLuint binding, GLuint buffer, GLintptr offset, GLsizei stride, GLuint divisor = 0) const;
    void attribute(GLuint index, GLuint binding, GLint components, GLenum type, GLuint relative_offset);
    void integer_attribute(GLuint index, GLuint binding, GLint components, GLenum type, GLuint relative_offset);
    void index_buffer(GLuint buffer);
    void bind() const { glBindVertexArray(id()); }

  private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
    };
    Handle<Traits> handle_;
};

/// Draws one triangle that covers the viewport; the vertex shader is shaders/lib/fullscreen.vert.
void draw_fullscreen();

}  // namespace tyndall::gl
