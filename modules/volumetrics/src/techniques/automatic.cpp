#include <algorithm>
#include <array>

#include "frame/resources.h"
#include "media/froxel_media.h"
#include "media/media.h"
#include "techniques/epipolar.h"
#include "techniques/froxel_fog.h"
#include "techniques/froxel_history.h"
#include "techniques/sprites.h"
#include "techniques/techniques.h"

// Each light goes to the estimator that does it best: the sun and the few lamps that light the medium most to
// epipolar lines, by pixel and sharp; the many other lamps to froxels, whose cost does not grow with the picture;
// ambient light and emission are closed form along each pixel's ray.

namespace tyndall::volumetrics {
namespace {

const std::array<std::string, 5> own_passes{
    froxel_pass("light", FroxelContent::many_lamps), froxel_pass("history", FroxelContent::many_lamps),
    froxel_pass("accumulate", FroxelContent::many_lamps), "volumetrics/many_lamps", "volumetrics/lamp_cores"};

const ProgramDesc program{.name = "volumetrics/many_lamps",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/many_lamps.frag"}},
                          .axes = {{"LOCAL_MEDIA", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = {}};
const ProgramRegistry::Registration registration(program);

bool is_valid(const Permutation& p) {
    return p.at("HEIGHT_MEDIA") == MAX_HEIGHT_MEDIA || p.at("LOCAL_MEDIA") == 0;
}

const ProgramDesc cores_program{.name = "volumetrics/lamp_cores",
                                .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/lamp_cores.vert"},
                                           {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/lamp_cores.frag"}},
                                .axes = {{"HEIGHT_MEDIA", {0, MAX_HEIGHT_MEDIA}},
                                         {"LOCAL_MEDIA", {0, 1}},  // in view, or they dim light
                                         {"LAMPS", {2}},
                                         {"CHROMATIC", {0, 1}},
                                         {"COUNT_WORK", {0, 1}}},
                                .valid = is_valid};
const ProgramRegistry::Registration cores_registration(cores_program);

/// What the froxels leave out near their lamps.
void add_lamp_cores(Frame& frame, const Fog& lamps, Estimate& estimate) {
    std::vector<std::uint32_t> drawn;
    for (const Lamp& lamp : frame.inputs.lamps)
        if (!is_sun(lamp, frame.inputs.eye) &&
            std::ranges::find(frame.media.few_lamps, lamp.index, &Lamp::index) == frame.media.few_lamps.end())
            drawn.push_back(lamp.index);
    const bool local = !frame.media.local.empty() || frame.resources.light_volumes.any();
    const bool heights = local || height_media_axis(frame.media) > 0;
    const FroxelMedia& media = froxel_media(frame, lamps.columns);
    const gl::Program& cores = frame.program(
        cores_program, {{"LAMPS", 2}, {"LOCAL_MEDIA", local}, {"HEIGHT_MEDIA", heights ? MAX_HEIGHT_MEDIA : 0}});
    frame.add({.name = "volumetrics/lamp_cores",
               .program = cores,
               .sources = {{frame.depth}, {media.scattering}, {media.extinction}},
               .fog = lamps,
               .targets = {&estimate.scattering},
               .lit = true,
               .light_volumes = true,
               .state = {.blend = gl::Blend::add},
               .set = [to_clip = frame.inputs.projection * frame.inputs.view](
                          const PassContext&, const gl::Program& p) { p.set("world_to_clip", to_clip); },
               .draw =
                   [&cores, drawn] {
                       for (const std::uint32_t lamp : drawn) {
                           cores.set("lamp", lamp);
                           draw_sprites(1);
                       }
                   }});
}

struct KeptByAutomatic : KeptTable {
    FroxelHistory history;
    [[nodiscard]] std::size_t bytes() const override { return KeptTable::bytes() + history.bytes(); }
};

/// Without shadow maps to ask, froxels take all lights.
Estimate add(Frame& frame) {
    if (!frame.inputs.has_shadow_maps) {
        const char* reason = "the host has no shaders/interface/shadow_maps.glsl";
        for (const char* name : {"volumetrics/epipolar_lines", "volumetrics/epipolar"}) frame.skip(name, reason);
        for (const std::string& name : own_passes) frame.skip(name, reason);
        return add_froxel(frame);
    }
    auto& kept = frame.kept<KeptByAutomatic>();
    Estimate estimate = add_epipolar(frame, true);
    if (frame.inputs.lamps.size() == frame.media.few_lamps.size()) {
        for (const std::string& name : own_passes)
            frame.skip(name, frame.inputs.lamps.empty() ? "no lamps" : "pixels take all lamps one by one");
        kept.history = {};
        return estimate;
    }
    FroxelHistory* history = frame.settings.froxels.history > 0 ? &kept.history : nullptr;
    if (history == nullptr) kept.history = {};
    const Fog lamps = add_froxel_fog(frame, froxel_columns(frame), history, FroxelContent::many_lamps);
    frame.add({.name = "volumetrics/many_lamps",
               .program = frame.program(program),
               .sources = {{frame.depth}},
               .fog = lamps,
               .targets = {&estimate.scattering},
               .state = {.blend = gl::Blend::add}});
    add_lamp_cores(frame, lamps, estimate);
    return estimate;
}

}  // namespace

TechniqueDesc automatic() {
    std::vector<std::string> passes = epipolar_passes();
    passes.insert(passes.end(), own_passes.begin(), own_passes.end());
    const std::vector<std::string> of_froxels = froxel().passes;
    passes.insert(passes.end(), of_froxels.begin(), of_froxels.end());
    return {.name = "auto",
            .help = "Sun and the lamps that matter most by epipolar lines, all other lamps by froxels.",
            .settings = "auto_",
            .passes = passes,
            .traits = {.sampling = Sampling::exact, .any_resolution = true, .few_lamps = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
