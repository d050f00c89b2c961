#include "frame/resources.h"
#include "media/froxel_media.h"
#include "media/froxel_tiles.h"
#include "shaders/shared/bindings.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_columns",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/media/froxel_columns.frag"}},
                          .axes = {{"TRANSPARENTS", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

/// `limits`: of transparents, or null.
TextureRef add_columns(Frame& frame, const char* name, const gl::Buffer* limits) {
    const glm::ivec2 count = froxel_size(frame.settings, frame.inputs.size);
    TextureRef columns = frame.passes.create(name, {.format = GL_R32F, .size = {count, 1}});
    frame.add({.name = name,
               .program = frame.program(program, {{"TRANSPARENTS", limits != nullptr}}),
               .sources = {{frame.inputs.depth}},
               .targets = {&columns},
               .set = [count, limits](const PassContext&, const gl::Program& shader) {
                   shader.set("column_count", glm::vec2(count));
                   if (limits != nullptr) limits->bind(GL_SHADER_STORAGE_BUFFER, BINDING_TRANSPARENT_DEPTHS);
               }});
    return columns;
}

}  // namespace

TextureRef froxel_columns(Frame& frame) {
    TextureRef& columns = frame.resources.this_frame.froxel_columns;
    if (!columns) columns = add_columns(frame, "volumetrics/froxel_columns", nullptr);
    return columns;
}

TextureRef transparent_columns(Frame& frame) {
    const std::vector<glm::vec2> depths =
        transparent_depths(frame.inputs, froxel_size(frame.settings, frame.inputs.size));
    gl::Buffer& limits = frame.resources.transparent_depths;
    limits.assign(std::span<const glm::vec2>(depths), "volumetrics transparents' depths");
    return add_columns(frame, "volumetrics/transparent_columns", &limits);
}

}  // namespace tyndall::volumetrics
