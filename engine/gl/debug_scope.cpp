#include "engine/gl/debug_scope.h"

#include <algorithm>

namespace tyndall::gl {
namespace {
constexpr std::size_t max_length = 255;  // GL_MAX_LABEL_LENGTH is at least 256 with the terminator

GLsizei clipped(std::string_view text) {
    return static_cast<GLsizei>(std::min(text.size(), max_length));
}
}  // namespace

DebugScope::DebugScope(std::string_view name) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, clipped(name), name.data());
}

DebugScope::~DebugScope() {
    glPopDebugGroup();
}

void label(GLenum identifier, GLuint name, std::string_view text) {
    glObjectLabel(identifier, name, clipped(text), text.data());
}

}  // namespace tyndall::gl
