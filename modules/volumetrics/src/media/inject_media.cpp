#include <algorithm>

#include "frame/passes.h"
#include "media/froxel_tiles.h"
#include "reconstruction/relight.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/inject_media",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/media/inject_media.comp"}},
                          .axes = {{"EMISSION", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

const ProgramDesc runs_program{.name = "volumetrics/froxel_runs",
                               .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/media/froxel_runs.comp"}},
                               .axes = {{"EMISSION", {0, 1}}, {"LIGHT_VOLUMES", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                               .valid = {}};
const ProgramRegistry::Registration runs_registration(runs_program);

/// For the march where it keeps visibility apart from light: see froxel_runs.comp.
TextureRef add_froxel_runs(PassList& passes, const PassResources& resources, const Inputs& inputs,
                           const FrameMedia& media, const FroxelMedia& froxels) {
    const glm::ivec3 size = passes.desc(froxels.extinction).size;
    const int words = (size.z + 31) / 32;
    glm::ivec2 live(size.z, 0);
    for (const IndexBox& box : media.local_froxels)
        live = {std::min(live.x, box.lower.z), std::max(live.y, box.upper.z)};
    TextureRef runs =
        passes.create("volumetrics/froxel_runs", {.format = GL_RG32UI, .size = {size.x * words, size.y, 1}});
    const gl::Program& shader =
        resources.shaders.get(runs_program, {{"EMISSION", media.local_emission},
                                             {"LIGHT_VOLUMES", static_cast<bool>(resources.light_volumes.sun())},
                                             {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/froxel_runs",
        [&](PassBuilder& builder) {
            builder.sample(froxels.columns);
            builder.sample(froxels.scattering);
            builder.sample(froxels.extinction);
            builder.sample(froxels.emission);
            builder.sample(resources.light_volumes.sun());
            runs = builder.storage_write(runs);
        },
        [froxels, runs, size, live, &shader, &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            const BoundTextures bound{{texture(froxels.columns), resources.nearest},
                                      {texture(froxels.scattering), resources.nearest},
                                      {texture(froxels.extinction), resources.nearest},
                                      {texture(froxels.emission), resources.nearest}};
            glBindImageTexture(0, context.texture(runs).id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32UI);
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.light_volumes.bind();
            shader.set("live_slices", live);
            shader.use();
            const glm::ivec2 groups = (glm::ivec2(size) + 7) / 8;
            glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 1);
        });
    return runs;
}

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
    if (settings.technique != Technique::ray_march) return froxels;
    if (const char* reason = reason_for_light(inputs, settings, media))
        passes.skip("volumetrics/froxel_runs", reason);
    else
        froxels.runs = add_froxel_runs(passes, resources, inputs, media, froxels);
    return froxels;
}

}  // namespace tyndall::volumetrics
