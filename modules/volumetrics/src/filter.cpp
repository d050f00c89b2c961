#include <array>
#include <cmath>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/filter",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/filter.frag"}},
                          .axes = {{"BILATERAL", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

/// exp(-x² / (2 sigma²)) for x = first … first + 3.
glm::vec4 gaussian(int first, float sigma) {
    glm::vec4 weights;
    for (int i = 0; i < 4; ++i) {
        const float x = static_cast<float>(first + i) / sigma;
        weights[i] = std::exp(-0.5F * x * x);
    }
    return weights;
}

Outputs add_direction(PassList& passes, const PassResources& resources, const Inputs& inputs,
                      const Settings& settings, const Outputs& source, const std::string& name,
                      glm::vec2 direction) {
    const bool bilateral = settings.filter_depth != FilterDepth::none;
    const bool chromatic = static_cast<bool>(source.transmittance);
    const TextureRef depth = bilateral ? inputs.depth : TextureRef{};
    Outputs target;
    target.scattering = passes.create(name + "/scattering", passes.desc(source.scattering));
    if (chromatic) target.transmittance = passes.create(name + "/transmittance", passes.desc(source.transmittance));

    const gl::Program& shader = resources.shaders.get(
        program, {{"BILATERAL", bilateral}, {"CHROMATIC", chromatic}, {"COUNT_WORK", inputs.count_work}});
    const glm::vec2 step = direction / glm::vec2(inputs.size);
    passes.add(
        name,
        [&](PassBuilder& builder) {
            builder.sample(depth);
            builder.sample(source.scattering);
            builder.sample(source.transmittance);
            target.scattering = builder.attach_color(target.scattering);
            if (chromatic) target.transmittance = builder.attach_color(target.transmittance);
        },
        [source, depth, step, sigma = settings.filter_sigma, falloff = settings.filter_depth_falloff, &shader,
         &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            const BoundTextures bound{{texture(depth), resources.nearest},
                                      {texture(source.scattering), resources.nearest},
                                      {texture(source.transmittance), resources.nearest}};
            shader.set("weights_0_3", gaussian(0, sigma));
            shader.set("weights_4_7", gaussian(4, sigma));
            shader.set("step_uv", step);
            shader.set("depth_falloff", falloff);
            shader.use();
            gl::draw_fullscreen();
        });
    return target;
}

}  // namespace

Outputs add_filter(PassList& passes, const PassResources& resources, const Inputs& inputs, const Settings& settings,
                 const Outputs& source) {
    const Outputs half_way =
        add_direction(passes, resources, inputs, settings, source, "volumetrics/filter_horizontal", {1, 0});
    return add_direction(passes, resources, inputs, settings, half_way, "volumetrics/filter_vertical", {0, 1});
}

}  // namespace tyndall::volumetrics
