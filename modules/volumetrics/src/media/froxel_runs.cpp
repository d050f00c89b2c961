#include "media/froxel_runs.h"

#include <algorithm>

#include "frame/resources.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_runs",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/media/froxel_runs.comp"}},
                          .axes = {{"EMISSION", {0, 1}}, {"LIGHT_VOLUMES", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

TextureRef add_froxel_runs(Frame& frame, const FroxelMedia& froxels) {
    const glm::ivec3 size = frame.passes.desc(froxels.extinction).size;
    glm::ivec2 live(size.z, 0);
    for (const IndexBox& box : frame.media.local_froxels)
        live = {std::min(live.x, box.lower.z), std::max(live.y, box.upper.z)};
    const int words = (size.z + 31) / 32;
    TextureRef runs =
        frame.passes.create("volumetrics/froxel_runs", {.format = GL_RG32UI, .size = {size.x * words, size.y, 1}});
    frame.add({.name = "volumetrics/froxel_runs",
               .program = frame.program(program, {{"EMISSION", frame.media.local_emission},
                                                  {"LIGHT_VOLUMES", frame.resources.light_volumes.axis() & 1}}),
               .sources = {{froxels.columns}, {froxels.scattering}, {froxels.extinction}, {froxels.emission}},
               .images = {{&runs}},
               .light_volumes = true,
               .set = [live](const PassContext&, const gl::Program& shader) { shader.set("live_slices", live); },
               .groups = {(size.x + 7) / 8, (size.y + 7) / 8, 1}});
    return runs;
}

}  // namespace tyndall::volumetrics
