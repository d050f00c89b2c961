#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{
    .name = "volumetrics/depth_downsample",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/depth_downsample.frag"}},
    .axes = {{"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

bool is_depth_buffer(const Frame& frame) {
    return frame.passes.desc(frame.depth).format == GL_DEPTH_COMPONENT32F;
}

void add_depth_downsample(Frame& frame) {
    const int factor = resolution_factor(frame.settings);
    if (factor == 1) return frame.skip("volumetrics/depth_downsample", "resolution is full");
    frame.size = (frame.inputs.size + factor - 1) / factor;
    frame.depth = frame.create("volumetrics/depth_downsample", GL_R32F);
    frame.add({.name = "volumetrics/depth_downsample",
               .program = frame.program(program),
               .sources = {{frame.inputs.depth}},
               .targets = {&frame.depth},
               .set = [factor, choice = static_cast<int>(frame.settings.resolution_depth)](
                          const PassContext&, const gl::Program& shader) {
                   shader.set("factor", factor);
                   shader.set("choice", choice);
               }});
}

}  // namespace tyndall::volumetrics
