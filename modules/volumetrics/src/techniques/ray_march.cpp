#include "frame/resources.h"
#include "media/froxel_runs.h"
#include "reconstruction/reconstruction.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

// See shaders/volumetrics/techniques/ray_march.frag.
namespace tyndall::volumetrics {
namespace {

bool is_valid(const Permutation& p) {
    if (!is_light_volume_permutation(p)) return false;
    if (p.at("VISIBILITY") == 0) return true;
    if (p.at("LAMPS") == 1 || (p.at("LAMPS") == 0 && p.at("HAS_SUN") == 0)) return false;
    return p.at("LOCAL_MEDIA") == 0 || p.at("CHROMATIC") == 0;
}

const ProgramDesc program{.name = "volumetrics/march",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1, 2}},  // 2: some emit
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"CHROMATIC", {0, 1}},
                                   {"LIGHT_VOLUMES", {0, 1, 2, 3}},
                                   {"VISIBILITY", {0, 1}},  // see reason_for_no_parts
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_valid};
const ProgramRegistry::Registration registration(program);

const char* reason_for_no_parts(const Frame& frame) {
    if (const char* reason = volumetrics::reason_for_no_parts(frame.settings)) return reason;
    if (!frame.inputs.has_sun && !frame.inputs.has_lamps) return "no sun and no lamps";
    if (frame.inputs.has_lamps && frame.settings.lamp_integration == LampIntegration::center)
        return "lamp_integration is center: unshadowed light is noisy, too";
    if (!frame.media.local.empty() && frame.media.chromatic)
        return "local media in view and extinction is coloured";
    return nullptr;
}

Part create_part(const Frame& frame, const std::string& name) {
    return {.light = frame.create("volumetrics/" + name), .share = frame.create("volumetrics/" + name + "_share")};
}

TextureRef add_runs(Frame& frame, const FroxelMedia& froxels, const char* whole) {
    if (frame.media.local.empty()) whole = "no local medium in view";
    if (!whole) return add_froxel_runs(frame, froxels);
    frame.skip("volumetrics/froxel_runs", whole);
    return {};
}

Estimate add(Frame& frame) {
    const char* whole = reason_for_no_parts(frame);
    const FroxelMedia& froxels = froxel_media(frame);
    const TextureRef runs = add_runs(frame, froxels, whole);
    Estimate estimate = frame.create_estimate();
    std::vector<TextureRef*> targets{&estimate.scattering, &estimate.transmittance};
    if (whole) {
        frame.skip("volumetrics/relight", whole);
        estimate.sampling = Sampling::per_pixel;
    } else {
        if (frame.inputs.has_sun) estimate.parts.push_back(create_part(frame, "sun"));
        if (frame.inputs.has_lamps) estimate.parts.push_back(create_part(frame, "lamps"));
        for (Part& part : estimate.parts) targets.insert(targets.end(), {&part.light, &part.share});
    }
    const bool local = !frame.media.local.empty();
    frame.add({.name = "volumetrics/march",
               .program = frame.program(program, {{"LOCAL_MEDIA", local + (local && frame.media.local_emission)},
                                                  {"VISIBILITY", whole == nullptr}}),
               .sources = {{frame.depth},
                           {froxels.scattering, true},
                           {froxels.extinction, true},
                           {froxels.emission, true},
                           {runs}},
               .targets = targets,
               .lit = true,
               .light_volumes = true});
    return estimate;
}

}  // namespace

TechniqueDesc ray_march() {
    return {.name = "ray_march",
            .help = "Marches each pixel's view ray; only visibility and local media are sampled.",
            .settings = "step",
            .passes = {"volumetrics/inject_media", "volumetrics/froxel_runs", "volumetrics/march"},
            .traits = {.sampling = Sampling::per_pixel, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
