#include "light/sky_light.h"
#include "media/media.h"
#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/refine_mask",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/refine_mask.frag"}},
                          .axes = {{"TEXTURES", {1, 2, 3}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

const char* reason_for_none(const Frame& frame, const Estimate& low) {
    if (resolution_factor(frame.settings) == 1) return "resolution is full";
    if (!frame.media.uses_grids || frame.media.local.empty()) return "no density grid is in view";
    if (!low.redraw) return "the technique sees density grids at any resolution";
    if (frame.settings.resolution.tolerance >= 1) return "resolution_tolerance is 1";
    const bool smoothed = frame.settings.filter.kernel != Filter::none || averages_frames(frame.settings);
    return low.sampling != Sampling::exact && smoothed ? "light without noise is not apart" : nullptr;
}

}  // namespace

void add_refine(Frame& frame, const Estimate& low, Estimate& estimate) {
    if (const char* reason = reason_for_none(frame, low)) {
        for (const char* name : {"volumetrics/refine_mask", "volumetrics/refine"}) frame.skip(name, reason);
        return;
    }
    TextureRef mask = frame.passes.create("volumetrics/refine_mask",
                                          {.format = GL_DEPTH_COMPONENT16, .size = {frame.inputs.size, 1}});
    std::vector<Pass::Source> sources{{frame.depth}, {low.scattering}};
    std::vector<TextureRef*> targets{&estimate.scattering, &estimate.transmittance};
    std::vector<TextureRef> unused(estimate.parts.size());  // shares have noise: those of low resolution stay
    for (std::size_t i = 0; i < estimate.parts.size(); ++i) {
        sources.push_back({low.parts[i].light});
        unused[i] = create_like(frame, "volumetrics/refine", estimate.parts[i].share, frame.inputs.size);
        targets.insert(targets.end(), {&estimate.parts[i].light, &unused[i]});
    }
    frame.add({.name = "volumetrics/refine_mask",
               .program = frame.program(program, {{"TEXTURES", static_cast<int>(sources.size()) - 1}}),
               .sources = sources,
               .depth_target = &mask,
               .state = {.depth_write = true},
               .set = [factor = resolution_factor(frame.settings), tolerance = frame.settings.resolution.tolerance](
                          const PassContext&, const gl::Program& shader) {
                   shader.set("factor", factor);
                   shader.set("tolerance", tolerance);
               }});
    Pass pass = low.redraw("volumetrics/refine", frame.inputs.depth);
    pass.targets = targets;
    pass.host_size = true;
    pass.depth_test = mask;
    pass.state = {.depth_test = true, .depth_func = GL_LESS};  // it is drawn at depth 0
    frame.add(pass);
    add_sky_light_again(frame, estimate, mask);
}

}  // namespace tyndall::volumetrics
