#include "frame/composite.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "frame/bound_sources.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/composite",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/frame/composite.frag"}},
                          .axes = {{"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

TextureRef add_composite(PassList& passes, ShaderLibrary& shaders, const Resources& resources,
                         const Outputs& outputs, TextureRef color, bool count_work) {
    const bool chromatic = static_cast<bool>(outputs.transmittance);
    const gl::Program& shader = shaders.get(program, {{"CHROMATIC", chromatic}, {"COUNT_WORK", count_work}});
    passes.add(
        "volumetrics/composite",
        [&](PassBuilder& builder) {
            builder.sample(outputs.scattering);
            builder.sample(outputs.transmittance);
            color = builder.attach_color(color);
        },
        [outputs, color, &shader, &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            // Every pixel reads the one texel that it writes, which a texture barrier allows (GL 4.5 core, 9.3.1).
            const BoundSources bound(context, {{color}, {outputs.scattering}, {outputs.transmittance}}, resources);
            glTextureBarrier();
            shader.use();
            gl::draw_fullscreen();
        });
    return color;
}

}  // namespace tyndall::volumetrics
