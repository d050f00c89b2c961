#pragma once

#include <string>

#include "engine/gl/framebuffer.h"
#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/graph/pass_list.h"
#include "engine/shader/shader_library.h"

namespace tyndall {

/// Shows any texture of the frame's pass list: layers, faces and slices, one channel or three, a value range.
class TextureViewer {
  public:
    explicit TextureViewer(ShaderLibrary& shaders);
    void panel(const PassList& passes);

  private:
    void choose(const std::vector<PassList::TextureInfo>& textures);
    void draw(const gl::TextureView& texture);
    void fit_range(const gl::TextureView& texture);
    /// The picture's size follows the texture's proportions.
    void resize(glm::ivec3 texture_size);
    ShaderLibrary& shaders_;
    gl::Texture picture_;
    gl::Framebuffer framebuffer_;
    gl::Sampler sampler_;
    std::string selected_;
    int slice_ = 0, channels_ = 0;
    float low_ = 0, high_ = 1;
};

}  // namespace tyndall
