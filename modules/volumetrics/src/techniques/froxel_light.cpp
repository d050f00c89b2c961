#include "shaders/shared/bindings.h"
#include "techniques/froxel_history.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

bool is_permutation(const Permutation& p) {
    if (p.at("LOCAL_MEDIA") == 0 && p.at("HEIGHT_MEDIA") > 1) return false;
    return p.at("FROXEL_HISTORY") == 0 || p.at("HAS_SUN") + p.at("LAMPS") > 0;
}

const ProgramDesc program{.name = "volumetrics/froxel_light",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_light.comp"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1}},  // in view, or they dim light
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"CHROMATIC", {0, 1}},
                                   {"FROXEL_HISTORY", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_permutation};
const ProgramRegistry::Registration registration(program);

/// RUN of froxel_light.comp, and its group size.
constexpr int run = 8, group_side = 16;

}  // namespace

FroxelLight add_froxel_light(PassList& passes, const PassResources& resources, const Inputs& inputs,
                             const Settings& settings, const FrameMedia& media, const FroxelMedia& froxels,
                             TextureRef columns, const FroxelHistory* history) {
    const glm::ivec3 size{settings.froxels_x, settings.froxels_y, settings.froxels_z};
    const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16F, .size = size, .levels = 1};
    FroxelLight light;
    light.radiance = passes.create("volumetrics/froxel_radiance", desc);
    if (history) {
        light.visibility = passes.create("volumetrics/froxel_visibility", desc);
        if (inputs.has_sun) light.sun = passes.create("volumetrics/froxel_sun", desc);
        if (inputs.has_lamps) light.lamps = passes.create("volumetrics/froxel_lamps", desc);
    }
    // Several height media are rare and slow: they have no program of their own without local media.
    const bool local = !media.local.empty() || resources.light_volumes.any() || height_media_axis(media) > 1;
    const int lamps = 1 + static_cast<int>(settings.lamp_integration);
    const gl::Program& shader = resources.shaders.get(program, {{"HEIGHT_MEDIA", height_media_axis(media)},
                                                                {"LOCAL_MEDIA", local},
                                                                {"HAS_SUN", inputs.has_sun},
                                                                {"LAMPS", inputs.has_lamps ? lamps : 0},
                                                                {"CHROMATIC", media.chromatic},
                                                                {"FROXEL_HISTORY", history != nullptr},
                                                                {"COUNT_WORK", inputs.count_work}});
    const bool lit = inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
    passes.add(
        "volumetrics/froxel_light",
        [&](PassBuilder& builder) {
            builder.sample(columns);
            builder.sample(froxels.scattering);
            builder.sample(froxels.extinction);
            builder.sample(froxels.emission);
            resources.light_volumes.sample(builder);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            for (TextureRef* ref : {&light.radiance, &light.visibility, &light.sun, &light.lamps})
                if (*ref) *ref = builder.storage_write(*ref);
        },
        [froxels, columns, light, history, bind_lighting = lit ? inputs.bind_lighting : nullptr, &shader,
         &resources, emits = media.local_emission,
         groups = glm::uvec3((size + glm::ivec3(group_side, group_side, run) - 1) /
                             glm::ivec3(group_side, group_side, run))](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{texture(columns), resources.nearest},
                                      {texture(froxels.scattering), resources.nearest},
                                      {texture(froxels.extinction), resources.nearest},
                                      {texture(emits ? froxels.emission : froxels.scattering), resources.nearest}};
            GLuint unit = 0;
            for (TextureRef ref : {light.radiance, light.visibility, light.sun, light.lamps}) {
                if (ref)
                    glBindImageTexture(unit, context.texture(ref).id, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
                ++unit;
            }
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.light_volumes.bind();
            if (history) shader.set("visibility_jitter", history->jitter());
            shader.use();
            glDispatchCompute(groups.x, groups.y, groups.z);
        });
    return light;
}

}  // namespace tyndall::volumetrics
