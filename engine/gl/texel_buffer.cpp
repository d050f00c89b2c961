#include "engine/gl/texel_buffer.h"

#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/gl/debug_scope.h"

namespace tyndall::gl {

void TexelBuffer::view(const std::string& label) {
    if (viewed_ == buffer_.id()) return;
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (buffer_.size() / 16 > static_cast<std::size_t>(most))
        throw Error(fmt::format("{}: {} texels, the driver allows {}", label, buffer_.size() / 16, most));
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    texels_ = Handle<Traits>(id);
    gl::label(GL_TEXTURE, id, label);
    glTextureBuffer(id, GL_RGBA32F, buffer_.id());
    viewed_ = buffer_.id();
}

void TexelBuffer::bind(GLuint image_unit) const {
    glBindImageTexture(image_unit, texels_.id(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
}

}  // namespace tyndall::gl
