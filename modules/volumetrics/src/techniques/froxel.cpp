#include "frame/resources.h"
#include "light/sky_light.h"
#include "media/noise_volume.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_fog.h"
#include "techniques/froxel_history.h"
#include "techniques/froxel_steps.h"
#include "techniques/techniques.h"
#include "volumetrics/volumetrics.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_apply",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/froxel_apply.frag"}},
                          .axes = {{"LOCAL_MEDIA", {0, 1}},
                                   {"GRIDS", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_grid_permutation};
const ProgramRegistry::Registration registration(program);

}  // namespace

Estimate add_froxel(Frame& frame) {
    const bool keeps = frame.settings.froxels.history > 0 && (frame.inputs.has_sun || frame.inputs.has_lamps);
    if (!keeps) frame.kept_by_technique.reset();
    Estimate estimate = frame.create_estimate();
    estimate.fog = add_froxel_fog(frame, froxel_columns(frame), keeps ? &frame.kept<FroxelHistory>() : nullptr);
    frame.add({.name = "volumetrics/froxel_apply",
               .program = frame.program(program),
               .sources = {{frame.depth}, {noise_volume(frame), true}},
               .fog = estimate.fog,
               .targets = {&estimate.scattering, &estimate.transmittance},
               // Behind the end of the froxels there are sun and ambient light, but neither lamps nor shadows.
               .lit = frame.inputs.has_sun || frame.inputs.has_ambient,
               .light_volumes = true,
               .local_media = true});
    return estimate;
}

Fog add_froxel_fog(Frame& frame, TextureRef columns, FroxelHistory* history, FroxelContent content) {
    const FroxelMedia& media = froxel_media(frame, columns);
    if (history != nullptr) history->begin_frame(frame.inputs, frame.settings, frame.media);
    FroxelLight light = add_froxel_light(frame, media, columns, history, content);
    if (content == FroxelContent::all) add_froxel_sky(frame, columns, light.radiance);
    TextureRef radiance = light.radiance;
    if (history != nullptr)
        radiance = add_froxel_history(frame, columns, light, *history);
    else
        frame.skip(froxel_pass("history", content),
                   frame.settings.froxels.history > 0 ? "neither sun nor lamps" : "froxel_history is 0");
    return add_froxel_accumulate(frame, media, columns, radiance, content);
}

void bind_fog_textures(const PassContext& context, const Fog& fog) {
    // Where there is no optical depth by channel the shader does not read it, but something must be bound.
    const TextureRef optical_depth = fog.optical_depth ? fog.optical_depth : fog.radiance;
    glBindTextureUnit(UNIT_FOG_COLUMNS, context.texture(fog.columns).id);
    glBindTextureUnit(UNIT_FOG_RADIANCE, context.texture(fog.radiance).id);
    glBindTextureUnit(UNIT_FOG_OPTICAL_DEPTH, context.texture(optical_depth).id);
    for (const GLuint unit : {UNIT_FOG_COLUMNS, UNIT_FOG_RADIANCE, UNIT_FOG_OPTICAL_DEPTH}) glBindSampler(unit, 0);
}

TechniqueDesc froxel() {
    return {.name = "froxel",
            .help = "Lights a grid of froxels, which transparents read too; its own history of visibility.",
            .settings = "froxel",
            .passes = {"volumetrics/froxel_columns", "volumetrics/noise_volume", "volumetrics/inject_media",
                       "volumetrics/froxel_light", "volumetrics/froxel_history", "volumetrics/froxel_accumulate",
                       "volumetrics/froxel_apply"},
            .traits = {.any_resolution = true},
            .add = add_froxel};
}

}  // namespace tyndall::volumetrics
