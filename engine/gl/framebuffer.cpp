#include "engine/gl/framebuffer.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/gl/debug_scope.h"

namespace tyndall::gl {
namespace {

void attach(GLuint framebuffer, GLenum point, const Attachment& attachment) {
    if (attachment.layer >= 0)
        glNamedFramebufferTextureLayer(framebuffer, point, attachment.texture.id, attachment.level,
                                       attachment.layer);
    else
        glNamedFramebufferTexture(framebuffer, point, attachment.texture.id, attachment.level);
}

const char* status_text(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "an attachment is not renderable or has no such level or layer";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "it has no attachment";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "the driver does not support this combination of formats";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "layered and single-layer attachments are mixed";
        default:
            return "incomplete";
    }
}

GLenum depth_point(GLenum format) {
    return format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8 ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                           : GL_DEPTH_ATTACHMENT;
}

}  // namespace

Framebuffer::Framebuffer(std::span<const Attachment> color, const Attachment* depth, const std::string& label) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    handle_ = Handle<Traits>(id);
    gl::label(GL_FRAMEBUFFER, id, label);

    std::vector<GLenum> draw_buffers;
    size_ = glm::ivec2(std::numeric_limits<int>::max());
    const auto add = [&](GLenum point, const Attachment& attachment) {
        TYNDALL_CHECK(attachment.texture);
        attach(id, point, attachment);
        const glm::ivec3 size = attachment.texture.desc.size;
        size_ = glm::min(size_, glm::max(glm::ivec2(size.x, size.y) >> attachment.level, glm::ivec2(1)));
    };
    for (const Attachment& attachment : color) {
        draw_buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size()));
        add(draw_buffers.back(), attachment);
    }
    if (depth != nullptr) add(depth_point(depth->texture.desc.format), *depth);

    if (draw_buffers.empty()) {
        glNamedFramebufferDrawBuffer(id, GL_NONE);
        glNamedFramebufferReadBuffer(id, GL_NONE);
    } else {
        glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    }
    const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error(fmt::format("framebuffer '{}': {} (status 0x{:x})", label, status_text(status), status));
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id());
    glViewport(0, 0, size_.x, size_.y);
}

}  // namespace tyndall::gl
