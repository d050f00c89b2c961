#include <algorithm>

#include "froxel_passes.h"
#include "froxel_tiles.h"
#include "passes.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/inject_media",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/inject_media.comp"}},
                          .axes = {{"EMISSION", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

FroxelMedia add_inject_media(PassList& passes, const PassResources& resources, const Inputs& inputs,
                             const Settings& settings, const FrameMedia& media) {
    const glm::ivec3 size{settings.froxels_x, settings.froxels_y, settings.froxels_z};
    const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16F, .size = size, .levels = 1};
    FroxelMedia froxels;
    froxels.columns = add_froxel_columns(passes, resources, inputs, settings);
    froxels.scattering = passes.create("volumetrics/froxel_scattering", desc);
    froxels.extinction = passes.create("volumetrics/froxel_extinction", desc);
    if (media.local_emission) froxels.emission = passes.create("volumetrics/froxel_emission", desc);

    const gl::Program& shader =
        resources.shaders.get(program, {{"EMISSION", media.local_emission}, {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/inject_media",
        [&](PassBuilder& builder) {
            builder.sample(froxels.columns);
            froxels.scattering = builder.storage_write(froxels.scattering);
            froxels.extinction = builder.storage_write(froxels.extinction);
            if (froxels.emission) froxels.emission = builder.storage_write(froxels.emission);
        },
        [froxels, tiles = static_cast<GLuint>(media.live_tiles), &shader, &resources](const PassContext& context) {
            const auto bind_image = [&](GLuint unit, TextureRef ref) {
                if (!ref) return;
                glClearTexImage(context.texture(ref).id, 0, GL_RGBA, GL_FLOAT, nullptr);
                glBindImageTexture(unit, context.texture(ref).id, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
            };
            bind_image(0, froxels.scattering);
            bind_image(1, froxels.extinction);
            bind_image(2, froxels.emission);
            const BoundTextures bound{{context.texture(froxels.columns), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.local_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
            resources.media_tiles.bind(GL_SHADER_STORAGE_BUFFER, BINDING_MEDIA_TILES);
            shader.set("tile_count", tiles);
            shader.use();
            constexpr GLuint row = 1024;  // more groups than one dimension takes
            glDispatchCompute(std::min(tiles, row), (tiles + row - 1) / row, 1);
        });
    return froxels;
}

}  // namespace tyndall::volumetrics
