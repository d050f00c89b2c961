#include "engine/gl/sampler.h"

#include "engine/gl/debug_scope.h"

namespace tyndall::gl {

Sampler::Sampler(const SamplerDesc& desc, const std::string& label) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    handle_ = Handle<Traits>(id);
    gl::label(GL_SAMPLER, id, label);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(desc.min_filter));
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(desc.mag_filter));
    for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glSamplerParameteri(id, axis, static_cast<GLint>(desc.wrap));
    glSamplerParameterfv(id, GL_TEXTURE_BORDER_COLOR, desc.border);
    if (desc.compare) {
        glSamplerParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(id, GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(desc.compare_func));
    }
    if (desc.max_anisotropy > 1) glSamplerParameterf(id, GL_TEXTURE_MAX_ANISOTROPY, desc.max_anisotropy);
}

}  // namespace tyndall::gl
