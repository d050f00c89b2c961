#include "techniques/fog_pass.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/analytic_fog",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/analytic_fog.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"HAS_SUN", {0, 1}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

Outputs add_analytic_fog(PassList& passes, PassResources& resources, const Inputs& inputs, const Settings&,
                         const FrameMedia& media) {
    Permutation permutation = fog_permutation(inputs, media);
    permutation["HAS_SUN"] = inputs.has_sun;
    const gl::Program& shader = resources.shaders.get(program, permutation);
    return add_fog_pass(passes, resources, inputs,
                        {"volumetrics/analytic_fog", shader, {}, fog_targets(passes, inputs, media)});
}

}  // namespace tyndall::volumetrics
