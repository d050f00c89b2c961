#include "techniques/sprites.h"

#include "engine/gl/vertex_array.h"

namespace tyndall::volumetrics {

void draw_sprites(GLsizei count) {
    const gl::VertexArray none("volumetrics sprites");
    none.bind();
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    glBindVertexArray(0);
}

}  // namespace tyndall::volumetrics
