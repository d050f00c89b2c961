#pragma once

#include <glm/vec2.hpp>

#include "engine/gl/buffer.h"
#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/gl/vertex_array.h"
#include "engine/shader/shader_library.h"

namespace tyndall {

/// Draws Dear ImGui's draw lists with the engine's own GL objects, so that the UI works in every kind of context.
/// An ImGui context must exist; its font texture is made here.
class ImguiRenderer {
  public:
    explicit ImguiRenderer(ShaderLibrary& shaders);
    /// Draws ImGui::GetDrawData() over colour attachment 0 of `framebuffer`, `size` in pixels.
    void draw(GLuint framebuffer, glm::ivec2 size);

  private:
    ShaderLibrary& shaders_;
    gl::Texture font_;
    gl::Sampler sampler_;
    gl::Buffer vertices_, indices_;
    gl::VertexArray vertex_array_;
};

}  // namespace tyndall
