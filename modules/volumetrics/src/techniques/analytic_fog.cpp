#include "techniques/analytic_fog.h"

#include "frame/resources.h"
#include "techniques/techniques.h"

// See shaders/volumetrics/techniques/analytic_fog.frag.
namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/analytic_fog",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/analytic_fog.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"HAS_SUN", {0, 1}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

}  // namespace

Estimate add_analytic_fog(Frame& frame) {
    Estimate estimate = frame.create_host_estimate();
    frame.add({.name = "volumetrics/analytic_fog",
               .program = frame.program(program),
               .sources = {{frame.inputs.depth}},
               .targets = {&estimate.scattering, &estimate.transmittance},
               .lit = true});
    return estimate;
}

TechniqueDesc analytic_fog() {
    return {.name = "analytic_fog",
            .help = "Fog in closed form with unshadowed suns; no lamps, no local media.",
            .settings = "fog_mode",
            .passes = {"volumetrics/analytic_fog"},
            .traits = {.glass = false, .local_media = false},
            .add = add_analytic_fog};
}

}  // namespace tyndall::volumetrics
