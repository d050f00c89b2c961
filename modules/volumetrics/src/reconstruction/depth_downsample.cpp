#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
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

bool is_depth_buffer(const PassList& passes, const Inputs& inputs) {
    return passes.desc(inputs.depth).format == GL_DEPTH_COMPONENT32F;
}

Inputs add_depth_downsample(PassList& passes, const PassResources& resources, const Inputs& inputs,
                            const Settings& settings) {
    const int factor = resolution_factor(settings);
    if (factor == 1) {
        passes.skip("volumetrics/depth_downsample", "resolution is full");
        return inputs;
    }
    Inputs low = inputs;
    low.size = (inputs.size + factor - 1) / factor;
    low.depth = passes.create("volumetrics/depth_downsample", {.format = GL_R32F, .size = {low.size, 1}});
    const gl::Program& shader = resources.shaders.get(program, {{"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/depth_downsample",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            low.depth = builder.attach_color(low.depth);
        },
        [depth = inputs.depth, factor, choice = static_cast<int>(settings.resolution_depth), &shader,
         &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            shader.set("factor", factor);
            shader.set("choice", choice);
            shader.use();
            gl::draw_fullscreen();
        });
    return low;
}

}  // namespace tyndall::volumetrics
