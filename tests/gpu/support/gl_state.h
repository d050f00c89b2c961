#pragma once
// All state of a context that a renderer may depend on, as what the driver says.

#include <glad/gl.h>

#include <map>
#include <string>
#include <vector>

#include "engine/gl/buffer.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/gl/vertex_array.h"

namespace tyndall::test {

/// Values by name: "depth func", "texture unit 3".
using GlState = std::map<std::string, std::vector<double>>;
[[nodiscard]] GlState gl_state();
/// Names of what differs, in order.
[[nodiscard]] std::vector<std::string> changed(const GlState& before, const GlState& after);

/// State that is as a renderer does not want it, wherever it can be, and objects of its own on every binding.
class HostileState {
  public:
    HostileState();
    void set() const;

  private:
    gl::Texture texture_, color_;
    gl::Buffer buffer_;
    gl::Sampler sampler_;
    gl::Framebuffer framebuffer_;
    gl::VertexArray vertices_;
    GLuint program_;
};

}  // namespace tyndall::test
