#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/upsample",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/upsample.frag"}},
                          .axes = {{"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

Outputs add_upsample(PassList& passes, const PassResources& resources, const Inputs& inputs, const Inputs& low,
                     const Settings& settings, const Outputs& source) {
    const bool chromatic = static_cast<bool>(source.transmittance);
    const auto full_size = [&](const char* name, TextureRef texture) {
        gl::TextureDesc desc = passes.desc(texture);
        desc.size = {inputs.size, 1};
        return passes.create(name, desc);
    };
    Outputs target = source;
    target.scattering = full_size("volumetrics/upsample/scattering", source.scattering);
    if (chromatic) target.transmittance = full_size("volumetrics/upsample/transmittance", source.transmittance);
    const gl::Program& shader =
        resources.shaders.get(program, {{"CHROMATIC", chromatic}, {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/upsample",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(low.depth);
            builder.sample(source.scattering);
            builder.sample(source.transmittance);
            target.scattering = builder.attach_color(target.scattering);
            if (chromatic) target.transmittance = builder.attach_color(target.transmittance);
        },
        [source, depth = inputs.depth, low_depth = low.depth, factor = resolution_factor(settings),
         mode = static_cast<int>(settings.upsample), falloff = settings.filter_depth_falloff, &shader,
         &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            const BoundTextures bound{{texture(depth), resources.nearest},
                                      {texture(low_depth), resources.nearest},
                                      {texture(source.scattering), resources.nearest},
                                      {texture(source.transmittance), resources.nearest}};
            shader.set("factor", factor);
            shader.set("mode", mode);
            shader.set("depth_falloff", falloff);
            shader.use();
            gl::draw_fullscreen();
        });
    return target;
}

}  // namespace tyndall::volumetrics
