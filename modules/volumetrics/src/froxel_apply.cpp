#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "froxel_passes.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_apply",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/march.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/froxel_apply.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

int height_media_axis(const FrameMedia& media) {
    const int heights = static_cast<int>(media.data.counts.x);
    return heights > 1 ? MAX_HEIGHT_MEDIA : heights;
}

Outputs add_froxel_apply(PassList& passes, const PassResources& resources, const Inputs& inputs,
                         const FrameMedia& media, TextureRef columns, const AccumulatedFroxels& froxels) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    Outputs outputs;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);
    const gl::Program& shader = resources.shaders.get(program, {{"HEIGHT_MEDIA", height_media_axis(media)},
                                                                {"LOCAL_MEDIA", !media.local.empty()},
                                                                {"HAS_SUN", inputs.has_sun},
                                                                {"CHROMATIC", media.chromatic},
                                                                {"COUNT_WORK", inputs.count_work}});
    // Behind the end of the froxels there are sun and ambient light, but neither lamps nor shadows.
    const bool lit = inputs.has_sun || inputs.has_ambient;
    passes.add(
        "volumetrics/froxel_apply",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(columns);
            builder.sample(froxels.radiance);
            builder.sample(froxels.optical_depth);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (outputs.transmittance) outputs.transmittance = builder.attach_color(outputs.transmittance);
        },
        [columns, froxels, depth = inputs.depth, bind_lighting = lit ? inputs.bind_lighting : nullptr, &shader,
         &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{texture(depth), resources.nearest},
                                      {texture(columns), resources.nearest},
                                      {texture(froxels.radiance), resources.nearest},
                                      {texture(froxels.optical_depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.use();
            gl::draw_fullscreen();
        });
    return outputs;
}

}  // namespace tyndall::volumetrics
