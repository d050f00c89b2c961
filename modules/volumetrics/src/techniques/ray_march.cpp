#include "frame/resources.h"
#include "media/noise_volume.h"
#include "reconstruction/reconstruction.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

// See shaders/volumetrics/techniques/ray_march.frag.
namespace tyndall::volumetrics {
namespace {

bool is_valid(const Permutation& p) {
    const int local = p.at("LOCAL_MEDIA");
    if (!is_grid_permutation(p) || !is_glass_permutation(p)) return false;
    const bool lit = p.at("HAS_SUN") + p.at("LAMPS") > 0;
    if (local == 1 && !lit) return false;
    if (local == 0 && lit && p.at("HEIGHT_MEDIA") > 1) return false;  // see local_media_axis
    if (p.at("PARTS") == 0) return true;
    if (p.at("LAMPS") == 1 || (p.at("LAMPS") == 0 && p.at("HAS_SUN") == 0)) return false;
    return true;
}

const ProgramDesc program{.name = "volumetrics/march",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1, 2}},  // 1: they only dim light, 2: in view
                                   {"GRIDS", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"GLASS", {0, 1, 2, 3}},
                                   {"CHROMATIC", {0, 1}},
                                   {"PARTS", {0, 1}},  // see reason_for_no_parts
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_valid};
const ProgramRegistry::Registration registration(program);

/// Several height media are rare and slow: lit ones have no program of their own without light volumes.
int local_media_axis(const Frame& frame) {
    if (!frame.media.local.empty()) return 2;
    const bool lit = frame.inputs.has_sun || frame.inputs.has_lamps;
    return frame.resources.light_volumes.any() || (lit && height_media_axis(frame.media) > 1) ? 1 : 0;
}

const char* reason_for_no_parts(const Frame& frame) {
    if (const char* reason = volumetrics::reason_for_no_parts(frame.settings)) return reason;
    if (!frame.inputs.has_sun && !frame.inputs.has_lamps) return "no sun and no lamps";
    if (frame.inputs.has_lamps && frame.settings.light.lamp_integration == LampIntegration::center)
        return "lamp_integration is center: unshadowed light is noisy, too";
    return nullptr;
}

Part create_part(const Frame& frame, const std::string& name) {
    return {.light = frame.create("volumetrics/" + name), .share = frame.create("volumetrics/" + name + "_share")};
}

Estimate add(Frame& frame) {
    const char* whole = reason_for_no_parts(frame);
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
    estimate.redraw =
        [&march = frame.program(program, {{"LOCAL_MEDIA", local_media_axis(frame)}, {"PARTS", whole == nullptr}}),
         noise = noise_volume(frame)](const std::string& name, TextureRef depth) {
            return Pass{.name = name,
                        .program = march,
                        .sources = {{depth}, {noise, true}},
                        .lit = true,
                        .light_volumes = true,
                        .local_media = true};
        };
    Pass pass = estimate.redraw("volumetrics/march", frame.depth);
    pass.targets = targets;
    frame.add(pass);
    return estimate;
}

}  // namespace

TechniqueDesc ray_march() {
    return {.name = "ray_march",
            .help = "Marches each pixel's view ray; only visibility is sampled.",
            .settings = "step",
            .passes = {"volumetrics/noise_volume", "volumetrics/march"},
            .traits = {.sampling = Sampling::per_pixel, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
