#include "fog_pass.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/radial_shafts",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/radial_shafts.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/radial_shafts.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"INTERVALS", {0, 1}},  // RadialOcclusion
                                   {"CHROMATIC", {0, 1}},
                                   {"RAYLEIGH", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_rayleigh_permutation};
const ProgramRegistry::Registration registration(program);

void skip_blur(PassList& passes, const std::string& reason) {
    for (const char* name : {"volumetrics/blur_horizontal", "volumetrics/blur_vertical"}) passes.skip(name, reason);
}

}  // namespace

Outputs add_radial_shafts(PassList& passes, PassResources& resources, const Inputs& inputs,
                          const Settings& settings, const FrameMedia& media) {
    if (!inputs.has_sun) {
        passes.skip("volumetrics/radial_shafts", "no sun");
        skip_blur(passes, "no sun");
        return add_analytic_fog(passes, resources, inputs, settings, media);
    }
    passes.skip("volumetrics/analytic_fog", "there is a sun");
    Permutation permutation = fog_permutation(inputs, media);
    permutation["INTERVALS"] = settings.radial_occlusion == RadialOcclusion::intervals;
    const gl::Program& shader = resources.shaders.get(program, permutation);
    const Outputs outputs = add_fog_pass(passes, resources, inputs, media, "volumetrics/radial_shafts", shader);
    if (settings.blur != Blur::none) return add_blur(passes, resources, inputs, settings, outputs);
    skip_blur(passes, "blur is none");
    return outputs;
}

}  // namespace tyndall::volumetrics
