#include "frame/resources.h"
#include "techniques/froxel_steps.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_accumulate",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_accumulate.comp"}},
                          .axes = {{"LOCAL_MEDIA", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

Fog add_froxel_accumulate(Frame& frame, const FroxelMedia& media, TextureRef columns, TextureRef radiance,
                          FroxelContent content) {
    Fog fog{.columns = columns, .radiance = radiance};
    const gl::TextureDesc desc = frame.passes.desc(radiance);
    if (media.extinction && frame.media.chromatic)
        fog.optical_depth = frame.passes.create("volumetrics/froxel_optical_depth", desc);
    frame.add({.name = froxel_pass("accumulate", content),
               .program = frame.program(program),
               .sources = {{columns}, {}, {media.extinction}},
               .images = {{&fog.radiance, true}, {&fog.optical_depth}},
               .groups = {(desc.size.x + 7) / 8, (desc.size.y + 7) / 8, 1}});
    return fog;
}

}  // namespace tyndall::volumetrics
