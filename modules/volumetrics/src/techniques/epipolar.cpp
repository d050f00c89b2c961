#include "light/epipolar.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "engine/gl/texture.h"
#include "frame/resources.h"
#include "media/noise_volume.h"
#include "shaders/shared/lights.h"
#include "techniques/epipolar.h"
#include "techniques/epipolar_sunlight.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

// The march of ray_march.frag without noise: what a light reaches of each segment comes from trees over rectified
// shadow maps (shaders/volumetrics/light/epipolar.glsl), so that segments are no finer than media ask for. With
// samples the sun's share of whole rays is taken at few samples along its lines (epipolar_samples.glsl), and pixels
// are given it from there.

namespace tyndall::volumetrics {
namespace {

const ProgramDesc lines_program{.name = "volumetrics/epipolar_lines",
                                .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/light/epipolar_lines.comp"}},
                                .axes = {{"SUN", {0, 1}}, {"GLASS", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                                .valid = [](const Permutation& p) { return p.at("GLASS") <= p.at("SUN"); }};
const ProgramRegistry::Registration lines_registration(lines_program);

/// EPIPOLAR 2 is without the sun, see epipolar_sunlight.h.
bool is_valid(const Permutation& p) {
    if (!is_epipolar_permutation(p) || !is_glass_permutation(p) || p.at("FEW_LAMPS") > p.at("LAMPS")) return false;
    return p.at("EPIPOLAR") == 1 || (p.at("HAS_SUN") == 0 && (p.at("GRIDS") == 0 || p.at("LOCAL_MEDIA") == 2));
}

const ProgramDesc program{.name = "volumetrics/epipolar",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                          .axes = {{"EPIPOLAR", {1, 2}},
                                   {"HEIGHT_MEDIA", {0, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {1, 2}},  // 1: none is in view
                                   {"GRIDS", {0, 1}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 2}},
                                   {"FEW_LAMPS", {0, 1}},  // technique auto
                                   {"GLASS", {0, 1, 2, 3}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_valid};
const ProgramRegistry::Registration registration(program);

constexpr int texels_a_row = 4096;  // EPIPOLAR_ROW_BITS
/// A power of two: the pool keeps what earlier frames had, and each of them has another number of lines.
int rows_of(std::int64_t texels) {
    return static_cast<int>(std::bit_ceil(static_cast<std::uint64_t>((texels + texels_a_row - 1) / texels_a_row)));
}

const char* reason_for_no_samples(const Frame& frame) {
    if (!frame.inputs.has_sun) return "no sun";
    if (!frame.inputs.sun_shadow) return "the sun casts no shadow";
    if ((frame.media.glass & GLASS_SUN) != 0) return "glass colours light finer than samples are apart";
    return samples_lines(frame.settings) ? nullptr : "epipolar_step is 1";
}

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

/// `cells_seen`: of the sun's lines by their samples; or empty.
TextureRef add_lines(Frame& frame, const EpipolarPlan& plan, TextureRef table, TextureRef cells_seen) {
    if (plan.lights.empty()) {
        frame.skip("volumetrics/epipolar_lines", "no light in view that casts shadows");
        return {};
    }
    TextureRef nodes = frame.passes.create("volumetrics/epipolar_nodes",
                                           {.format = GL_RG32F, .size = {texels_a_row, rows_of(plan.nodes), 1}});
    const bool sun = plan.lights.front().index == 0, lamps = plan.lights.back().index > 0;
    const gl::Program* of_sun =
        sun ? &frame.program(lines_program, {{"SUN", 1}, {"GLASS", frame.media.glass & GLASS_SUN}}) : nullptr;
    const gl::Program* of_lamps = lamps ? &frame.program(lines_program, {{"SUN", 0}, {"GLASS", 0}}) : nullptr;
    frame.add({.name = "volumetrics/epipolar_lines",
               .program = sun ? *of_sun : *of_lamps,
               .sources = {{table}, {cells_seen}},
               .images = {{&nodes}},
               .lit = true,
               .draw = [of_sun, of_lamps, lights = plan.lights, sampled = static_cast<bool>(cells_seen)] {
                   for (const EpipolarLines& light : lights) {
                       const gl::Program& lines = light.index == 0 ? *of_sun : *of_lamps;
                       lines.set("sampled", static_cast<int>(sampled && light.index == 0));
                       lines.set("light", static_cast<int>(light.index));
                       lines.use();
                       glDispatchCompute(static_cast<GLuint>(light.lines), 1, 1);
                   }
               }});
    return nodes;
}

}  // namespace

Estimate add_epipolar(Frame& frame, bool few_lamps) {
    if (!frame.inputs.has_shadow_maps) {
        std::vector<std::string> names = epipolar_sunlight_passes();
        names.insert(names.end(), {"volumetrics/epipolar_lines", "volumetrics/epipolar"});
        for (const std::string& name : names)
            frame.skip(name, "the host has no shaders/interface/shadow_maps.glsl");
        return {};
    }
    const EpipolarPlan plan = plan_epipolar(frame.inputs, few_lamps ? frame.media.few_lamps : frame.inputs.lamps,
                                            frame.settings, frame.size);
    const TextureRef table = upload_table(frame, plan);
    std::optional<EpipolarSunlight> sunlight;
    const char* without_samples = reason_for_no_samples(frame);
    if (without_samples == nullptr)
        sunlight.emplace(frame, plan.lights.front(), table);
    else
        for (const std::string& name : epipolar_sunlight_passes()) frame.skip(name, without_samples);
    const TextureRef nodes = add_lines(frame, plan, table, sunlight ? sunlight->counts : TextureRef{});
    Permutation permutation = epipolar_permutation(frame);
    permutation["EPIPOLAR"] = 1;
    permutation["FEW_LAMPS"] = few_lamps && !frame.media.few_lamps.empty();
    permutation["GLASS"] = frame.media.glass;
    if (few_lamps && std::ranges::none_of(frame.media.few_lamps, &Lamp::through_glass))
        permutation["GLASS"] &= ~GLASS_LAMPS;
    permutation["LAMPS"] = frame.inputs.has_lamps && (!few_lamps || !frame.media.few_lamps.empty()) ? 2 : 0;
    Pass::Source samples, fixed_up;
    if (sunlight) {
        sunlight->add_passes(nodes);
        samples = {sunlight->unwarped};
        fixed_up = {sunlight->fixed_up};
        permutation["EPIPOLAR"] = 2;
        permutation["HAS_SUN"] = 0;
        permutation["GLASS"] &= ~GLASS_SUN;
        if (frame.media.uses_grids) permutation["LOCAL_MEDIA"] = 2;
    }
    Estimate estimate = frame.create_estimate();
    if (sunlight && frame.inputs.samples)
        estimate.samples = sunlight->add_view();
    else if (sunlight)
        frame.skip("volumetrics/epipolar_view", "nobody asks for it");
    const auto draw = [&march = frame.program(program, permutation), noise = noise_volume(frame), table, nodes,
                       samples, fixed_up,
                       tree = frame.settings.epipolar.tree](const std::string& name, TextureRef depth) {
        return Pass{.name = name,
                    .program = march,
                    .sources = {{depth}, {noise, true}, {table}, {nodes}, {}, {}, samples, fixed_up},
                    .lit = true,
                    .light_volumes = true,
                    .local_media = true,
                    .set = [tree](const PassContext&, const gl::Program& p) {
                        p.set("coarsest_level", coarsest_epipolar_level(tree));
                    }};
    };
    Pass pass = draw("volumetrics/epipolar", frame.depth);
    pass.targets = {&estimate.scattering, &estimate.transmittance};
    frame.add(pass);
    // What samples are of has the pass's own resolution.
    if (!sunlight && !few_lamps) estimate.redraw = draw;
    return estimate;
}

const std::vector<std::string>& epipolar_passes() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{"volumetrics/epipolar_lines", "volumetrics/noise_volume",
                                     "volumetrics/epipolar"};
        all.insert(all.end(), epipolar_sunlight_passes().begin(), epipolar_sunlight_passes().end());
        return all;
    }();
    return names;
}

TechniqueDesc epipolar() {
    return {.name = "epipolar",
            .help = "Marches with shares of light from min/max trees along epipolar lines: sharp, without noise.",
            .settings = "epipolar_",
            .passes = epipolar_passes(),
            .traits = {.sampling = Sampling::exact, .any_resolution = true},
            .add = [](Frame& frame) { return add_epipolar(frame, false); }};
}

}  // namespace tyndall::volumetrics
