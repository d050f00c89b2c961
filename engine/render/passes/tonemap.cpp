#include "engine/render/passes/tonemap.h"

#include <cmath>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall {
namespace {

const ProgramDesc program{
    "tonemap",
    {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/engine/tonemap.frag"}},
    {},
    {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

float exposure_factor(float ev100, float bias) {
    return std::exp2(bias - ev100) / 1.2f;
}

TextureRef add_tonemap(FrameContext& frame, TextureRef color, TextureRef display) {
    frame.passes.add(
        "tonemap",
        [&](PassBuilder& pass) {
            pass.sample(color);
            display = pass.attach_color(display);
        },
        [&frame, color](const PassContext& pass) {
            pass.bind_framebuffer();
            gl::apply({});
            frame.shaders.get(program).use();
            glBindTextureUnit(0, pass.texture(color).id);
            glBindSampler(0, 0);
            gl::draw_fullscreen();
        });
    return display;
}

}  // namespace tyndall
