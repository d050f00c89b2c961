#include "engine/render/passes/acceptance_view.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall {
namespace {

const ProgramDesc program{"acceptance_view",
                          {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                           {GL_FRAGMENT_SHADER, "shaders/engine/acceptance_view.frag"}},
                          {},
                          {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

TextureRef add_acceptance_view(FrameContext& frame, TextureRef acceptance, TextureRef display) {
    frame.passes.add(
        "acceptance_view",
        [&](PassBuilder& pass) {
            pass.sample(acceptance);
            display = pass.attach_color(display);
        },
        [&frame, acceptance](const PassContext& pass) {
            pass.bind_framebuffer();
            gl::apply({});
            frame.shaders.get(program).use();
            glBindTextureUnit(0, pass.texture(acceptance).id);
            glBindSampler(0, 0);
            gl::draw_fullscreen();
        });
    return display;
}

}  // namespace tyndall
