#include "light/epipolar.h"

#include <bit>

#include "engine/gl/texture.h"
#include "frame/resources.h"
#include "media/noise_volume.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

// The march of ray_march.frag without noise: what a light reaches of each segment comes from trees over rectified
// shadow maps (shaders/volumetrics/light/epipolar.glsl), so that segments are no finer than media ask for.

namespace tyndall::volumetrics {
namespace {

const ProgramDesc lines_program{.name = "volumetrics/epipolar_lines",
                                .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/light/epipolar_lines.comp"}},
                                .axes = {{"COUNT_WORK", {0, 1}}},
                                .valid = {}};
const ProgramRegistry::Registration lines_registration(lines_program);

bool is_valid(const Permutation& p) {
    return is_grid_permutation(p) && (p.at("HEIGHT_MEDIA") == MAX_HEIGHT_MEDIA || p.at("LOCAL_MEDIA") == 1);
}

const ProgramDesc program{.name = "volumetrics/epipolar",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                          .axes = {{"EPIPOLAR", {1}},
                                   {"HEIGHT_MEDIA", {0, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {1, 2}},  // 1: none is in view
                                   {"GRIDS", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 2}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_valid};
const ProgramRegistry::Registration registration(program);

constexpr int texels_a_row = 4096;  // EPIPOLAR_ROW_BITS
/// A power of two: the pool keeps what earlier frames had, and each of them has another number of lines.
int rows_of(std::int64_t texels) {
    return static_cast<int>(std::bit_ceil(static_cast<std::uint64_t>((texels + texels_a_row - 1) / texels_a_row)));
}

/// The table of lights, which the CPU writes.
struct KeptTable : Kept {
    gl::Texture texture;
    [[nodiscard]] std::size_t bytes() const override { return texture ? gl::byte_size(texture.desc()) : 0; }
};

TextureRef upload_table(Frame& frame, const EpipolarPlan& plan) {
    std::vector<glm::vec4> texels = plan.table();
    const int rows = rows_of(static_cast<std::int64_t>(texels.size()));
    texels.resize(static_cast<std::size_t>(rows) * texels_a_row);
    const gl::TextureDesc desc{.format = GL_RGBA32F, .size = {texels_a_row, rows, 1}};
    gl::Texture& texture = frame.kept<KeptTable>().texture;
    if (!texture || texture.desc() != desc) texture = gl::Texture(desc, "volumetrics epipolar lights");
    texture.upload(0, GL_RGBA, GL_FLOAT, texels.data());
    return frame.passes.import("volumetrics/epipolar_lights", texture);
}

TextureRef add_lines(Frame& frame, const EpipolarPlan& plan, TextureRef table) {
    if (plan.lights.empty()) {
        frame.skip("volumetrics/epipolar_lines", "no light in view that casts shadows");
        return {};
    }
    TextureRef nodes = frame.passes.create("volumetrics/epipolar_nodes",
                                           {.format = GL_RG32F, .size = {texels_a_row, rows_of(plan.nodes), 1}});
    const gl::Program& lines = frame.program(lines_program);
    frame.add({.name = "volumetrics/epipolar_lines",
               .program = lines,
               .sources = {{table}},
               .images = {{&nodes}},
               .lit = true,
               .draw = [&lines, lights = plan.lights] {
                   for (const EpipolarLines& light : lights) {
                       lines.set("light", static_cast<int>(light.index));
                       glDispatchCompute(static_cast<GLuint>(light.lines), 1, 1);
                   }
               }});
    return nodes;
}

Estimate add(Frame& frame) {
    if (!frame.inputs.has_shadow_maps) {
        for (const char* name : {"volumetrics/epipolar_lines", "volumetrics/epipolar"})
            frame.skip(name, "the host has no shaders/interface/shadow_maps.glsl");
        return {};
    }
    const EpipolarPlan plan = plan_epipolar(frame.inputs, frame.settings, frame.size);
    const TextureRef table = upload_table(frame, plan);
    const TextureRef nodes = add_lines(frame, plan, table);
    Estimate estimate = frame.create_estimate();
    const bool local = !frame.media.local.empty();
    const bool heights = local || height_media_axis(frame.media) > 0;
    estimate.redraw = [&march = frame.program(program, {{"EPIPOLAR", 1},
                                                        {"HEIGHT_MEDIA", heights ? MAX_HEIGHT_MEDIA : 0},
                                                        {"LOCAL_MEDIA", local ? 2 : 1},
                                                        {"LAMPS", frame.inputs.has_lamps ? 2 : 0}}),
                       noise = noise_volume(frame), table, nodes](const std::string& name, TextureRef depth) {
        return Pass{.name = name,
                    .program = march,
                    .sources = {{depth}, {noise, true}, {table}, {nodes}},
                    .lit = true,
                    .light_volumes = true,
                    .local_media = true};
    };
    Pass pass = estimate.redraw("volumetrics/epipolar", frame.depth);
    pass.targets = {&estimate.scattering, &estimate.transmittance};
    frame.add(pass);
    return estimate;
}

}  // namespace

TechniqueDesc epipolar() {
    return {.name = "epipolar",
            .help = "Marches with shares of light from min/max trees along epipolar lines: sharp, without noise.",
            .settings = "epipolar_",
            .passes = {"volumetrics/epipolar_lines", "volumetrics/noise_volume", "volumetrics/epipolar"},
            .traits = {.sampling = Sampling::exact, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
