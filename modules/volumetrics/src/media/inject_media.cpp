#include <algorithm>

#include "frame/resources.h"
#include "media/froxel_media.h"
#include "media/froxel_tiles.h"
#include "shaders/shared/bindings.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/inject_media",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/media/inject_media.comp"}},
                          .axes = {{"EMISSION", {0, 1}}, {"GRIDS", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

FroxelMedia add_inject_media(Frame& frame, TextureRef columns) {
    const gl::TextureDesc desc{
        .kind = gl::TextureKind::d3, .format = GL_RGBA16F, .size = froxel_size(frame.settings, frame.inputs.size)};
    FroxelMedia froxels;
    froxels.scattering = frame.passes.create("volumetrics/froxel_scattering", desc);
    froxels.extinction = frame.passes.create("volumetrics/froxel_extinction", desc);
    if (frame.media.local_emission) froxels.emission = frame.passes.create("volumetrics/froxel_emission", desc);

    const std::vector<std::uint32_t> live = live_tiles(frame.media.local_froxels, desc.size);
    frame.resources.media_tiles.assign(std::span<const std::uint32_t>(live), "volumetrics media tiles");
    const auto tiles = static_cast<GLuint>(live.size() / (1 + (frame.media.local.size() + 31) / 32));
    constexpr GLuint row = 1024;  // more groups than one dimension takes
    frame.add(
        {.name = "volumetrics/inject_media",
         .program = frame.program(program, {{"EMISSION", frame.media.local_emission}}),
         .sources = {{columns}},
         .images = {{&froxels.scattering}, {&froxels.extinction}, {&froxels.emission}},
         .local_media = true,
         .set =
             [froxels, tiles, &resources = frame.resources](const PassContext& context, const gl::Program& shader) {
                 for (const TextureRef ref : {froxels.scattering, froxels.extinction, froxels.emission})
                     if (ref) glClearTexImage(context.texture(ref).id, 0, GL_RGBA, GL_FLOAT, nullptr);
                 resources.media_tiles.bind(GL_SHADER_STORAGE_BUFFER, BINDING_MEDIA_TILES);
                 shader.set("tile_count", tiles);
             },
         .groups = {std::min(tiles, row), (tiles + row - 1) / row, 1}});
    return froxels;
}

}  // namespace

const FroxelMedia& froxel_media(Frame& frame, TextureRef columns) {
    std::optional<FroxelMedia>& froxels = frame.resources.this_frame.froxel_media;
    if (!froxels && frame.media.local.empty()) {
        froxels.emplace();
        frame.skip("volumetrics/inject_media", "no local medium in view");
    } else if (!froxels) {
        froxels = add_inject_media(frame, columns);
    }
    return *froxels;
}

}  // namespace tyndall::volumetrics
