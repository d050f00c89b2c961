#include "light/sky_light.h"

#include <algorithm>

#include "media/froxel_media.h"
#include "media/media.h"
#include "media/noise_volume.h"
#include "volumetrics/frame.h"
#include "volumetrics/technique.h"

namespace tyndall::volumetrics {
namespace {

const PermutationAxis height_media{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}}, local_media{"LOCAL_MEDIA", {0, 1}},
    sky{"SKY_VISIBILITY", {1}}, chromatic{"CHROMATIC", {0, 1}}, count_work{"COUNT_WORK", {0, 1}};

/// One program serves all frames with local media or several height media.
bool serves(const Permutation& p) {
    return p.at("LOCAL_MEDIA") == 1 ? p.at("HEIGHT_MEDIA") == MAX_HEIGHT_MEDIA : p.at("HEIGHT_MEDIA") <= 1;
}
bool is_valid(const Permutation& p) {
    return is_grid_permutation(p) && serves(p);
}

const ProgramDesc program{.name = "volumetrics/sky_light",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/light/sky_light.frag"}},
                          .axes = {height_media, local_media, {"GRIDS", {0, 1}}, sky, chromatic, count_work},
                          .valid = is_valid};
const ProgramDesc froxel_program{
    .name = "volumetrics/froxel_sky",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_light.comp"}},
    .axes = {height_media, local_media, sky, {"SKY_ALONE", {1}}, {"LAMPS", {0}}, chromatic, count_work},
    .valid = serves};
const ProgramRegistry::Registration registration(program), froxel_registration(froxel_program);

Permutation permutation(const Frame& frame) {
    const bool local = !frame.media.local.empty() || height_media_axis(frame.media) > 1;
    Permutation p{{"LOCAL_MEDIA", local}, {"SKY_VISIBILITY", 1}};
    if (local) p["HEIGHT_MEDIA"] = MAX_HEIGHT_MEDIA;
    return p;
}

Pass sky_pass(Frame& frame, const std::string& name, TextureRef depth, float nearest) {
    const bool interactive = technique(frame.settings.technique).traits.interactive;
    const int steps = interactive ? frame.settings.light.sky_steps : std::max(frame.settings.light.sky_steps, 64);
    return {.name = name,
            .program = frame.program(program, permutation(frame)),
            .sources = {{depth}, {noise_volume(frame), true}},
            .lit = true,
            .local_media = true,
            .state = {.blend = gl::Blend::add},
            .set = [steps, nearest](const PassContext&, const gl::Program& shader) {
                shader.set("steps", steps);
                shader.set("nearest", nearest);
            }};
}

}  // namespace

void add_sky_light(Frame& frame, Estimate& estimate) {
    if (!frame.inputs.has_sky_radiance || !estimate) return;
    // The froxels have it already.
    const float nearest = estimate.fog ? frame.media.data.froxel_depths.y : 0.0F;
    const bool low = glm::ivec2(frame.passes.desc(estimate.scattering).size) == frame.size;
    Pass pass = sky_pass(frame, "volumetrics/sky_light", low ? frame.depth : frame.inputs.depth, nearest);
    pass.targets = {&estimate.scattering};
    pass.host_size = !low;
    frame.add(pass);
}

void add_sky_light_again(Frame& frame, Estimate& estimate, TextureRef mask) {
    if (!frame.inputs.has_sky_radiance) return;
    Pass pass = sky_pass(frame, "volumetrics/sky_light_again", frame.inputs.depth, 0);
    pass.targets = {&estimate.scattering};
    pass.host_size = true;
    pass.depth_test = mask;
    pass.state.depth_test = true;
    pass.state.depth_func = GL_LESS;  // it is drawn at depth 0
    frame.add(pass);
}

void add_froxel_sky(Frame& frame, TextureRef columns, TextureRef& radiance) {
    if (!frame.inputs.has_sky_radiance) return;
    constexpr int run = 8;  // slices that one invocation lights
    const FroxelMedia& media = froxel_media(frame, columns);
    const glm::ivec3 size = frame.passes.desc(radiance).size;
    Permutation p = permutation(frame);
    p["SKY_ALONE"] = 1;
    p["LAMPS"] = 0;
    frame.add({.name = "volumetrics/froxel_sky",
               .program = frame.program(froxel_program, p),
               .sources = {{columns},
                           {media.scattering},
                           {media.extinction},
                           {frame.media.local_emission ? media.emission : media.scattering}},
               .images = {{&radiance, true}},
               .lit = true,
               .set =
                   [](const PassContext&, const gl::Program& shader) {
                       shader.set("run", run);
                       shader.set("many_lamps", 0);
                   },
               .groups = (size + glm::ivec3(15, 15, run - 1)) / glm::ivec3(16, 16, run)});
}

const std::vector<std::string>& sky_light_passes() {
    static const std::vector<std::string> names{"volumetrics/sky_light", "volumetrics/sky_light_again",
                                                "volumetrics/froxel_sky"};
    return names;
}

}  // namespace tyndall::volumetrics
