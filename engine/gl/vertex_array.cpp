#include "engine/gl/vertex_array.h"

#include "engine/gl/debug_scope.h"

namespace tyndall::gl {

VertexArray::VertexArray(const std::string& label) {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    handle_ = Handle<Traits>(id);
    gl::label(GL_VERTEX_ARRAY, id, label);
}

void VertexArray::vertex_buffer(GLuint binding, GLuint buffer, GLintptr offset, GLsizei stride,
                                GLuint divisor) const {
    glVertexArrayVertexBuffer(id(), binding, buffer, offset, stride);
    glVertexArrayBindingDivisor(id(), binding, divisor);
}

void VertexArray::attribute(GLuint index, GLuint binding, GLint components, GLenum type, GLuint relative_offset) {
    glEnableVertexArrayAttrib(id(), index);
    glVertexArrayAttribFormat(id(), index, components, type, GL_FALSE, relative_offset);
    glVertexArrayAttribBinding(id(), index, binding);
}

void VertexArray::integer_attribute(GLuint index, GLuint binding, GLint components, GLenum type,
                                    GLuint relative_offset) {
    glEnableVertexArrayAttrib(id(), index);
    glVertexArrayAttribIFormat(id(), index, components, type, relative_offset);
    glVertexArrayAttribBinding(id(), index, binding);
}

void VertexArray::index_buffer(GLuint buffer) {
    glVertexArrayElementBuffer(id(), buffer);
}

// Core profile draws need a vertex array. One made for the call cannot outlive its context.
void draw_fullscreen() {
    const VertexArray empty("fullscreen");
    empty.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

}  // namespace tyndall::gl
