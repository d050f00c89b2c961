#include "fog_pass.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc visibility_program{.name = "volumetrics/radial_visibility",
                                     .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/radial_visibility.vert"},
                                                {GL_FRAGMENT_SHADER, "shaders/volumetrics/radial_visibility.frag"}},
                                     .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                              {"INTERVALS", {0, 1}},  // RadialOcclusion
                                              {"CHROMATIC", {0, 1}},
                                              {"COUNT_WORK", {0, 1}}},
                                     .valid = {}};
const ProgramRegistry::Registration visibility_registration(visibility_program);

const ProgramDesc program{.name = "volumetrics/radial_shafts",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/march.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/radial_shafts.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

/// R16F: the sun's share over each pixel's ray.
TextureRef add_visibility(PassList& passes, const PassResources& resources, const Inputs& inputs,
                          const Settings& settings, const FrameMedia& media) {
    Permutation permutation = fog_permutation(inputs, media);
    permutation["INTERVALS"] = settings.radial_occlusion == RadialOcclusion::intervals;
    Outputs visibility;
    visibility.scattering =
        passes.create("volumetrics/radial_visibility", {.format = GL_R16F, .size = {inputs.size, 1}});
    const gl::Program& shader = resources.shaders.get(visibility_program, permutation);
    visibility = add_fog_pass(passes, resources, inputs, {"volumetrics/radial_visibility", shader, {}, visibility});
    if (settings.blur != Blur::none) return add_blur(passes, resources, inputs, settings, visibility).scattering;
    return visibility.scattering;
}

void skip_blur(PassList& passes, const std::string& reason) {
    for (const char* name : {"volumetrics/blur_horizontal", "volumetrics/blur_vertical"}) passes.skip(name, reason);
}

}  // namespace

Outputs add_radial_shafts(PassList& passes, PassResources& resources, const Inputs& inputs,
                          const Settings& settings, const FrameMedia& media) {
    if (!inputs.has_sun) {
        for (const char* name : {"volumetrics/radial_visibility", "volumetrics/radial_shafts"})
            passes.skip(name, "no sun");
        skip_blur(passes, "no sun");
        return add_analytic_fog(passes, resources, inputs, settings, media);
    }
    passes.skip("volumetrics/analytic_fog", "there is a sun");
    if (settings.blur == Blur::none) skip_blur(passes, "blur is none");
    const TextureRef visibility = add_visibility(passes, resources, inputs, settings, media);
    const gl::Program& shader = resources.shaders.get(program, fog_permutation(inputs, media));
    return add_fog_pass(passes, resources, inputs,
                        {"volumetrics/radial_shafts", shader, visibility, fog_targets(passes, inputs, media)});
}

}  // namespace tyndall::volumetrics
