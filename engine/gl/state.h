#pragma once

#include <glad/gl.h>

#include <glm/vec4.hpp>

namespace tyndall::gl {

/// premultiplied: dst = src + dst * src.a; over: dst.rgb = src.rgb + dst.rgb * (1 - src.a); through, of two
/// sources: dst.rgb = src.rgb + dst.rgb * src1.rgb; filter: dst.rgb *= src.rgb, dst.a = max(src.a, dst.a).
enum class Blend { none, premultiplied, add, over, through, filter };

/// All fixed-function state a draw depends on, set as a whole: nothing leaks from pass to pass.
/// Depth is reversed (greater is nearer), clip depth 0..1 with the origin at the lower left.
struct DrawState {
    bool depth_test = false;
    bool depth_write = false;
    GLenum depth_func = GL_GEQUAL;
    GLenum cull = GL_NONE;   ///< GL_NONE, GL_BACK, GL_FRONT
    bool clockwise = false;  ///< front faces are wound so: those of mirrored instances
    Blend blend = Blend::none;
    bool depth_clamp = false;
    float slope_bias = 0;     ///< glPolygonOffset factor, 0 = off
    float constant_bias = 0;  ///< glPolygonOffset units
    bool color_write = true;
};
void apply(const DrawState& state);

}  // namespace tyndall::gl
