#include <gtest/gtest.h>

#include "engine/gl/state.h"
#include "support/gl_test.h"

namespace tyndall::test {
namespace {

class GlBlend : public GlTest {};

// Drivers refuse draws with several targets while a dual-source function is set, blending or not.
TEST_F(GlBlend, NoBlendingForgetsADualSourceFunction) {
    gl::apply({.blend = gl::Blend::premultiplied});
    glBlendFunc(GL_ONE, GL_SRC1_COLOR);
    gl::apply(gl::DrawState{});
    GLint function = 0;
    glGetIntegerv(GL_BLEND_DST_RGB, &function);
    EXPECT_EQ(function, GL_ZERO);
    EXPECT_EQ(glIsEnabled(GL_BLEND), GL_FALSE);
}

}  // namespace
}  // namespace tyndall::test
