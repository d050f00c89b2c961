#include "frame/resources.h"
#include "media/froxel_media.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_columns",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/media/froxel_columns.frag"}},
                          .axes = {{"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

TextureRef froxel_columns(Frame& frame) {
    TextureRef& columns = frame.resources.this_frame.froxel_columns;
    if (columns) return columns;
    const glm::ivec2 count{frame.settings.froxels.x, frame.settings.froxels.y};
    columns = frame.passes.create("volumetrics/froxel_columns", {.format = GL_R32F, .size = {count, 1}});
    frame.add({.name = "volumetrics/froxel_columns",
               .program = frame.program(program),
               .sources = {{frame.inputs.depth}},
               .targets = {&columns},
               .set = [count](const PassContext&, const gl::Program& shader) {
                   shader.set("column_count", glm::vec2(count));
               }});
    return columns;
}

}  // namespace tyndall::volumetrics
