#pragma once

#include <string>

#include "engine/gl/handle.h"

namespace tyndall::gl {

struct SamplerDesc {
    GLenum min_filter = GL_LINEAR;
    GLenum mag_filter = GL_LINEAR;
    GLenum wrap = GL_CLAMP_TO_EDGE;
    bool compare = false;  ///< depth compare; `compare_func` is what "lit" means
    GLenum compare_func = GL_GEQUAL;
    float max_anisotropy = 1;
    float border[4] = {0, 0, 0, 0};
};

class Sampler {
  public:
    Sampler() = default;
    Sampler(const SamplerDesc& desc, const std::string& label);
    [[nodiscard]] GLuint id() const { return handle_.id(); }

  private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
    };
    Handle<Traits> handle_;
};

}  // namespace tyndall::gl
