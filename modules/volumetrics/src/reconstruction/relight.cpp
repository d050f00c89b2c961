#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/relight",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/relight.frag"}},
                          .axes = {{"PARTS", {1, 2, 3, 4}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

void add_relight(Frame& frame, Estimate& estimate) {
    std::vector<Pass::Source> sources{{estimate.scattering}};
    for (const Part& part : estimate.parts) sources.insert(sources.end(), {{part.light}, {part.share}});
    estimate.scattering = create_like(frame, "volumetrics/relight", estimate.scattering, frame.inputs.size);
    frame.add({.name = "volumetrics/relight",
               .program = frame.program(program, {{"PARTS", static_cast<int>(estimate.parts.size())}}),
               .sources = sources,
               .targets = {&estimate.scattering}});
}

}  // namespace tyndall::volumetrics
