#include "frame/resources.h"
#include "techniques/analytic_fog.h"
#include "techniques/techniques.h"

// See shaders/volumetrics/techniques/radial_shafts.frag and radial_visibility.frag.
namespace tyndall::volumetrics {
namespace {

const ProgramDesc visibility_program{
    .name = "volumetrics/radial_visibility",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/radial_visibility.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/radial_visibility.frag"}},
    .axes = {{"INTERVALS", {0, 1}},  // RadialOcclusion
             {"CHROMATIC", {0, 1}},
             {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration visibility_registration(visibility_program);

const ProgramDesc program{
    .name = "volumetrics/radial_shafts",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/radial_shafts.frag"}},
    .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program);

/// The sun's visible share over each pixel's ray.
TextureRef add_visibility(Frame& frame) {
    const bool intervals = frame.settings.radial_shafts.occlusion == RadialOcclusion::intervals;
    TextureRef share = frame.create("volumetrics/sun_share");
    frame.add({.name = "volumetrics/radial_visibility",
               .program = frame.program(visibility_program, {{"INTERVALS", intervals}}),
               .sources = {{frame.depth}},
               .targets = {&share},
               .lit = true});
    return share;
}

/// The sun of the fog is all that has shafts. Fog itself is a closed form, at the host's resolution.
Estimate add(Frame& frame) {
    if (!frame.inputs.has_sun) {
        for (const char* name : {"volumetrics/radial_visibility", "volumetrics/radial_shafts"})
            frame.skip(name, "no sun");
        return add_analytic_fog(frame);
    }
    frame.skip("volumetrics/analytic_fog", "there is a sun");
    Estimate estimate = frame.create_host_estimate();
    Part sun{.light = frame.passes.create("volumetrics/sun", frame.passes.desc(estimate.scattering)),
             .share = add_visibility(frame)};
    frame.add({.name = "volumetrics/radial_shafts",
               .program = frame.program(program),
               .sources = {{frame.inputs.depth}},
               .targets = {&estimate.scattering, &sun.light, &estimate.transmittance},
               .lit = true});
    estimate.parts.push_back(sun);
    return estimate;
}

}  // namespace

TechniqueDesc radial_shafts() {
    return {
        .name = "radial_shafts",
        .help = "Analytic fog whose brightest sun is shadowed by what the screen shows; no lamps, no local media.",
        .settings = "radial_",
        .passes = {"volumetrics/analytic_fog", "volumetrics/radial_visibility", "volumetrics/radial_shafts"},
        .traits = {.sampling = Sampling::per_pixel, .any_resolution = true, .glass = false, .local_media = false},
        .add = add};
}

}  // namespace tyndall::volumetrics
