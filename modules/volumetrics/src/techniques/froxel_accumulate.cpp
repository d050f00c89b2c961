#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_accumulate",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_accumulate.comp"}},
                          .axes = {{"LOCAL_MEDIA", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

AccumulatedFroxels add_froxel_accumulate(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                         const Settings& settings, const FrameMedia& media,
                                         const FroxelMedia& froxels, TextureRef columns, TextureRef radiance) {
    const bool local = !media.local.empty();
    AccumulatedFroxels result{.radiance = radiance, .optical_depth = {}};
    if (local && media.chromatic)
        result.optical_depth = passes.create("volumetrics/froxel_optical_depth", passes.desc(radiance));
    const gl::Program& shader = resources.shaders.get(
        program, {{"LOCAL_MEDIA", local}, {"CHROMATIC", media.chromatic}, {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/froxel_accumulate",
        [&](PassBuilder& builder) {
            builder.sample(columns);
            builder.sample(froxels.extinction);
            result.radiance = builder.storage_read_write(radiance);
            if (result.optical_depth) result.optical_depth = builder.storage_write(result.optical_depth);
        },
        [columns, extinction = froxels.extinction, result, &shader, &resources,
         groups =
             glm::uvec2((settings.froxels_x + 7) / 8, (settings.froxels_y + 7) / 8)](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            const BoundTextures bound{{texture(columns), resources.nearest},
                                      {gl::TextureView(), resources.nearest},
                                      {texture(extinction), resources.nearest}};
            glBindImageTexture(0, context.texture(result.radiance).id, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
            if (result.optical_depth)
                glBindImageTexture(1, context.texture(result.optical_depth).id, 0, GL_TRUE, 0, GL_WRITE_ONLY,
                                   GL_RGBA16F);
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.use();
            glDispatchCompute(groups.x, groups.y, 1);
        });
    return result;
}

}  // namespace tyndall::volumetrics
