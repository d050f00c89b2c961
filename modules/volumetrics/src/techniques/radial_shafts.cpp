#include "reconstruction/reconstruction.h"
#include "techniques/fog_pass.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc visibility_program{
    .name = "volumetrics/radial_visibility",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/radial_visibility.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/radial_visibility.frag"}},
    .axes = {{"INTERVALS", {0, 1}},  // RadialOcclusion
             {"CHROMATIC", {0, 1}},
             {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration visibility_registration(visibility_program);

const ProgramDesc program{
    .name = "volumetrics/radial_shafts",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/radial_shafts.frag"}},
    .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program);

/// R16F in `scattering`: the sun's share over each pixel's ray.
Outputs add_visibility(PassList& passes, const PassResources& resources, const Inputs& inputs,
                       const Settings& settings, const FrameMedia& media, TemporalHistory& history) {
    const Inputs low = add_depth_downsample(passes, resources, inputs, settings);
    Outputs visibility;
    visibility.scattering =
        passes.create("volumetrics/radial_visibility", {.format = GL_R16F, .size = {low.size, 1}});
    const gl::Program& shader = resources.shaders.get(
        visibility_program, {{"INTERVALS", settings.radial_occlusion == RadialOcclusion::intervals},
                             {"CHROMATIC", media.chromatic},
                             {"COUNT_WORK", inputs.count_work}});
    visibility = add_fog_pass(passes, resources, low, {"volumetrics/radial_visibility", shader, {}, visibility});
    return add_reconstruction(passes, resources, inputs, low, settings, visibility, history);
}

}  // namespace

Outputs add_radial_shafts(PassList& passes, PassResources& resources, const Inputs& inputs,
                          const Settings& settings, const FrameMedia& media, TemporalHistory& history) {
    passes.skip("volumetrics/analytic_fog", "there is a sun");
    const Outputs visibility = add_visibility(passes, resources, inputs, settings, media, history);
    const gl::Program& shader = resources.shaders.get(program, fog_permutation(inputs, media));
    Outputs outputs = add_fog_pass(
        passes, resources, inputs,
        {"volumetrics/radial_shafts", shader, visibility.scattering, fog_targets(passes, inputs, media)});
    outputs.acceptance = visibility.acceptance;
    return outputs;
}

}  // namespace tyndall::volumetrics
