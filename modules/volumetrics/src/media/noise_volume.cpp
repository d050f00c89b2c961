#include "media/noise_volume.h"

#include "frame/resources.h"
#include "media/froxel_media.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/noise_volume",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/media/noise_volume.comp"}},
                          .axes = {{"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

TextureRef add_noise_volume(Frame& frame) {
    if (!frame.media.local_noise) {
        frame.skip("volumetrics/noise_volume", "no local medium with noise in view");
        return {};
    }
    const glm::ivec3 size{frame.settings.froxels.x, frame.settings.froxels.y, frame.settings.froxels.z + 1};
    TextureRef sums = frame.passes.create("volumetrics/noise_volume",
                                          {.kind = gl::TextureKind::d3, .format = GL_RG32F, .size = size});
    frame.add({.name = "volumetrics/noise_volume",
               .program = frame.program(program),
               .sources = {{froxel_columns(frame)}},
               .images = {{&sums}},
               .local_media = true,
               .set =
                   [sums](const PassContext& context, const gl::Program&) {
                       glClearTexImage(context.texture(sums).id, 0, GL_RG, GL_FLOAT, nullptr);
                   },
               .groups = {(size.x + 7) / 8, (size.y + 7) / 8, 1}});
    return sums;
}

}  // namespace

TextureRef noise_volume(Frame& frame) {
    std::optional<TextureRef>& sums = frame.resources.this_frame.noise_volume;
    if (!sums) sums = add_noise_volume(frame);
    return *sums;
}

}  // namespace tyndall::volumetrics
