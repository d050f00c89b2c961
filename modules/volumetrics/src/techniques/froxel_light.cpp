#include "engine/gl/program_limits.h"
#include "frame/resources.h"
#include "media/froxel_grid.h"
#include "techniques/froxel_history.h"
#include "techniques/froxel_steps.h"

namespace tyndall::volumetrics {
namespace {

bool is_permutation(const Permutation& p) {
    if (!is_grid_permutation(p) || !is_glass_permutation(p) ||
        (p.at("LOCAL_MEDIA") == 0 && p.at("HEIGHT_MEDIA") > 1))
        return false;
    return p.at("FROXEL_HISTORY") == 0 || p.at("HAS_SUN") + p.at("LAMPS") > 0;
}

const ProgramDesc program{.name = "volumetrics/froxel_light",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_light.comp"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1}},  // in view, or they dim light
                                   {"GRIDS", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"GLASS", {0, 1, 2, 3}},
                                   {"CHROMATIC", {0, 1}},
                                   {"FROXEL_HISTORY", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_permutation};
const ProgramRegistry::Registration registration(program);

/// Slices that one invocation lights: one where lamps are so many that a driver would end the loop over them early.
int run_of_slices(const Frame& frame) {
    constexpr std::size_t run = 8, rounds = 6;  // for a lamp and slice, see expect_lamps()
    return frame.inputs.lamps.size() > gl::loop_rounds() / (rounds * run) ? 1 : run;
}

}  // namespace

FroxelLight add_froxel_light(Frame& frame, const FroxelMedia& media, TextureRef columns,
                             const FroxelHistory* history, FroxelContent content) {
    const glm::ivec3 size = froxel_size(frame.settings, frame.inputs.size);
    const auto create = [&](const char* name, bool wanted) {
        const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16F, .size = size};
        return wanted ? frame.passes.create(name, desc) : TextureRef{};
    };
    const bool keeps = history != nullptr;
    const bool has_sun = frame.inputs.has_sun && content == FroxelContent::all;
    FroxelLight light{.radiance = create("volumetrics/froxel_radiance", true),
                      .visibility = create("volumetrics/froxel_visibility", keeps),
                      .sun = create("volumetrics/froxel_sun", keeps && has_sun),
                      .lamps = create("volumetrics/froxel_lamps", keeps && frame.inputs.has_lamps),
                      .content = content};
    // Several height media are rare and slow: they have no program of their own without local media.
    const bool local =
        !frame.media.local.empty() || frame.resources.light_volumes.any() || height_media_axis(frame.media) > 1;
    Permutation permutation{{"LOCAL_MEDIA", local}, {"HAS_SUN", has_sun}, {"FROXEL_HISTORY", keeps}};
    // Without their cores lamps change little within a froxel: its middle stands for it.
    if (content == FroxelContent::many_lamps) permutation["LAMPS"] = 1 + static_cast<int>(LampIntegration::center);
    const int run = run_of_slices(frame);
    const glm::ivec3 group{16, 16, run};
    frame.add({.name = froxel_pass("light", content),
               .program = frame.program(program, permutation),
               .sources = {{columns},
                           {media.scattering},
                           {media.extinction},
                           {frame.media.local_emission ? media.emission : media.scattering}},
               .images = {{&light.radiance}, {&light.visibility}, {&light.sun}, {&light.lamps}},
               .lit = true,
               .light_volumes = true,
               .set =
                   [history, run, content](const PassContext&, const gl::Program& shader) {
                       shader.set("run", run);
                       shader.set("many_lamps", static_cast<int>(content == FroxelContent::many_lamps));
                       if (history != nullptr) shader.set("visibility_jitter", history->jitter());
                   },
               .groups = (size + group - 1) / group});
    return light;
}

}  // namespace tyndall::volumetrics
