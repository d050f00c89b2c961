#include "adapter/acceptance_view.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall {
namespace {

const ProgramDesc program{"acceptance_view",
                          {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                           {GL_FRAGMENT_SHADER, "shaders/adapter/acceptance_view.frag"}},
                          {},
                          {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

Image acceptance_picture(const Image& shares, glm::ivec2 size) {
    Image to(size, 3);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 texel = (2 * glm::ivec2(x, y) + 1) * shares.size / (2 * size);
            const float share = *shares.at(texel.x, texel.y);
            to.at(x, y)[0] = 1 - share;
            to.at(x, y)[1] = share;
        }
    return to;
}

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
