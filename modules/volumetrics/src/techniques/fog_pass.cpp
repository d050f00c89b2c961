#include "techniques/fog_pass.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {

Permutation fog_permutation(const Inputs& inputs, const FrameMedia& media) {
    return {{"HEIGHT_MEDIA", height_media_axis(media)},
            {"CHROMATIC", media.chromatic},
            {"COUNT_WORK", inputs.count_work}};
}

Outputs fog_targets(PassList& passes, const Inputs& inputs, const FrameMedia& media) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    Outputs targets;
    targets.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) targets.transmittance = passes.create("volumetrics/transmittance", desc);
    return targets;
}

Outputs add_fog_pass(PassList& passes, const PassResources& resources, const Inputs& inputs, const FogPass& pass) {
    Outputs outputs = pass.targets;
    const bool lit = inputs.has_sun || inputs.has_ambient;
    passes.add(
        pass.name,
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(pass.visibility);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (outputs.transmittance) outputs.transmittance = builder.attach_color(outputs.transmittance);
        },
        [depth = inputs.depth, visibility = pass.visibility, bind_lighting = lit ? inputs.bind_lighting : nullptr,
         &shader = pass.shader, &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{texture(depth), resources.nearest},
                                      {texture(visibility), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.noise.bind();
            shader.use();
            gl::draw_fullscreen();
        });
    return outputs;
}

}  // namespace tyndall::volumetrics
