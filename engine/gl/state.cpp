#include "engine/gl/state.h"

#include <initializer_list>

namespace tyndall::gl {
namespace {

void enable(GLenum capability, bool on) {
    if (on)
        glEnable(capability);
    else
        glDisable(capability);
}

void apply_blend(Blend blend) {
    enable(GL_BLEND, blend != Blend::none);
    glBlendEquationSeparate(GL_FUNC_ADD, blend == Blend::filter ? GL_MAX : GL_FUNC_ADD);
    // A dual-source function left behind would make every draw with several targets an error, blended or not.
    if (blend == Blend::none) return glBlendFunc(GL_ONE, GL_ZERO);
    // Premultiplied: alpha is a transmittance, and transmittances multiply.
    if (blend == Blend::premultiplied)
        glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_SRC_ALPHA);
    else if (blend == Blend::over)
        glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    else if (blend == Blend::through)
        glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
    else if (blend == Blend::filter)
        glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_ONE);
    else
        glBlendFunc(GL_ONE, GL_ONE);
}

void apply_depth(const DrawState& state) {
    // GL writes depth only while the test is enabled.
    enable(GL_DEPTH_TEST, state.depth_test || state.depth_write);
    glDepthFunc(state.depth_test ? state.depth_func : GL_ALWAYS);
    glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    glDepthRangef(0.0f, 1.0f);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    enable(GL_DEPTH_CLAMP, state.depth_clamp);
    enable(GL_POLYGON_OFFSET_FILL, state.slope_bias != 0 || state.constant_bias != 0);
    glPolygonOffset(state.slope_bias, state.constant_bias);
}

}  // namespace

// Nothing is filtered by what was set before: a host engine or a UI library may have changed any of it.
void apply(const DrawState& state) {
    apply_depth(state);
    apply_blend(state.blend);
    enable(GL_CULL_FACE, state.cull != GL_NONE);
    if (state.cull != GL_NONE) glCullFace(state.cull);
    glFrontFace(state.clockwise ? GL_CW : GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    const GLboolean color = state.color_write ? GL_TRUE : GL_FALSE;
    glColorMask(color, color, color, color);
    for (GLenum off : {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD,
                       GL_COLOR_LOGIC_OP, GL_PRIMITIVE_RESTART, GL_SAMPLE_ALPHA_TO_COVERAGE})
        glDisable(off);
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
}

}  // namespace tyndall::gl
