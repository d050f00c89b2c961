#include "frame/resources.h"
#include "techniques/froxel_history.h"
#include "techniques/froxel_steps.h"

namespace tyndall::volumetrics {
namespace {

bool is_permutation(const Permutation& p) {
    return is_light_volume_permutation(p) && (p.at("FROXEL_HISTORY") == 0 || p.at("HAS_SUN") + p.at("LAMPS") > 0);
}

const ProgramDesc program{.name = "volumetrics/froxel_light",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_light.comp"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"CHROMATIC", {0, 1}},
                                   {"FROXEL_HISTORY", {0, 1}},
                                   {"LIGHT_VOLUMES", {0, 1, 2, 3}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_permutation};
const ProgramRegistry::Registration registration(program);

/// Froxels of a group of froxel_light.comp: its columns, and RUN.
constexpr glm::ivec3 group{16, 16, 8};

}  // namespace

FroxelLight add_froxel_light(Frame& frame, const FroxelMedia& media, TextureRef columns,
                             const FroxelHistory* history) {
    const Settings& settings = frame.settings;
    const glm::ivec3 size{settings.froxels_x, settings.froxels_y, settings.froxels_z};
    const auto create = [&](const char* name, bool wanted) {
        const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16F, .size = size};
        return wanted ? frame.passes.create(name, desc) : TextureRef{};
    };
    const bool keeps = history != nullptr;
    FroxelLight light{.radiance = create("volumetrics/froxel_radiance", true),
                      .visibility = create("volumetrics/froxel_visibility", keeps),
                      .sun = create("volumetrics/froxel_sun", keeps && frame.inputs.has_sun),
                      .lamps = create("volumetrics/froxel_lamps", keeps && frame.inputs.has_lamps)};
    const bool local = !frame.media.local.empty(), emits = frame.media.local_emission;
    frame.add({.name = "volumetrics/froxel_light",
               .program = frame.program(program, {{"FROXEL_HISTORY", keeps}}),
               .sources =
                   {{columns}, {media.scattering}, {media.extinction}, {emits ? media.emission : media.scattering}},
               .images = {{&light.radiance}, {&light.visibility}, {&light.sun}, {&light.lamps}},
               .lit = true,
               .light_volumes = true,
               .set =
                   [local, emits, history](const PassContext&, const gl::Program& shader) {
                       if (local) shader.set("local_emission", emits ? 1 : 0);
                       if (history != nullptr) shader.set("visibility_jitter", history->jitter());
                   },
               .groups = (size + group - 1) / group});
    return light;
}

}  // namespace tyndall::volumetrics
