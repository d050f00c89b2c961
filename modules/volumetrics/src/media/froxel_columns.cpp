#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_columns",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/media/froxel_columns.frag"}},
                          .axes = {{"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

TextureRef add_froxel_columns(PassList& passes, const PassResources& resources, const Inputs& inputs,
                              const Settings& settings) {
    const glm::ivec2 count{settings.froxels_x, settings.froxels_y};
    TextureRef columns = passes.create("volumetrics/froxel_columns", {.format = GL_R32F, .size = {count, 1}});
    const gl::Program& shader = resources.shaders.get(program, {{"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/froxel_columns",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            columns = builder.attach_color(columns);
        },
        [depth = inputs.depth, count, &shader, &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.set("column_count", glm::vec2(count));
            shader.use();
            gl::draw_fullscreen();
        });
    return columns;
}

}  // namespace tyndall::volumetrics
