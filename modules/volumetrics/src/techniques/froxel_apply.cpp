#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"
#include "volumetrics/volumetrics.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_apply",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/froxel_apply.frag"}},
                          .axes = {{"HAS_SUN", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

void Volumetrics::sample_fog(PassBuilder& builder, const Fog& fog) {
    for (TextureRef texture : {fog.columns, fog.radiance, fog.optical_depth}) builder.sample(texture);
}

void bind_fog_textures(const PassContext& context, const Fog& fog) {
    // Where there is no optical depth by channel the shader does not read it, but something must be bound.
    const TextureRef optical_depth = fog.optical_depth ? fog.optical_depth : fog.radiance;
    glBindTextureUnit(UNIT_FOG_COLUMNS, context.texture(fog.columns).id);
    glBindTextureUnit(UNIT_FOG_RADIANCE, context.texture(fog.radiance).id);
    glBindTextureUnit(UNIT_FOG_OPTICAL_DEPTH, context.texture(optical_depth).id);
    for (const GLuint unit : {UNIT_FOG_COLUMNS, UNIT_FOG_RADIANCE, UNIT_FOG_OPTICAL_DEPTH}) glBindSampler(unit, 0);
}

Outputs add_froxel_apply(PassList& passes, const PassResources& resources, const Inputs& inputs,
                         const FrameMedia& media, const Fog& fog) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    Outputs outputs;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);
    const gl::Program& shader = resources.shaders.get(
        program, {{"HAS_SUN", inputs.has_sun}, {"CHROMATIC", media.chromatic}, {"COUNT_WORK", inputs.count_work}});
    // Behind the end of the froxels there are sun and ambient light, but neither lamps nor shadows.
    const bool lit = inputs.has_sun || inputs.has_ambient;
    passes.add(
        "volumetrics/froxel_apply",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            Volumetrics::sample_fog(builder, fog);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (outputs.transmittance) outputs.transmittance = builder.attach_color(outputs.transmittance);
        },
        [fog, depth = inputs.depth, bind_lighting = lit ? inputs.bind_lighting : nullptr, &shader,
         &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            bind_fog_textures(context, fog);
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.use();
            gl::draw_fullscreen();
        });
    return outputs;
}

}  // namespace tyndall::volumetrics
