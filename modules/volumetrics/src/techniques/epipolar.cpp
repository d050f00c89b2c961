#include "light/epipolar.h"

#include <bit>

#include "engine/gl/texture.h"
#include "frame/resources.h"
#include "media/noise_volume.h"
#include "shaders/shared/bindings.h"
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
                                .axes = {{"COUNT_WORK", {0, 1}}},
                                .valid = {}};
const ProgramRegistry::Registration lines_registration(lines_program);

ProgramDesc share_program(const std::string& name, GLenum stage, const std::string& file) {
    ProgramDesc desc{.name = "volumetrics/" + name,
                     .stages = {{stage, "shaders/volumetrics/light/" + file}},
                     .axes = {{"COUNT_WORK", {0, 1}}},
                     .valid = {}};
    if (stage == GL_FRAGMENT_SHADER)
        desc.stages.insert(desc.stages.begin(), {GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"});
    return desc;
}
const ProgramDesc sources_program = share_program("epipolar_sources", GL_COMPUTE_SHADER, "epipolar_sources.comp");
const ProgramRegistry::Registration sources_registration(sources_program);
const ProgramDesc interpolate_program =
    share_program("epipolar_interpolate", GL_FRAGMENT_SHADER, "epipolar_interpolate.frag");
const ProgramRegistry::Registration interpolate_registration(interpolate_program);
const ProgramDesc unwarp_program = share_program("epipolar_unwarp", GL_FRAGMENT_SHADER, "epipolar_unwarp.frag");
const ProgramRegistry::Registration unwarp_registration(unwarp_program);

/// EPIPOLAR 2, whose sunlight is unshadowed, has no program of its own for height media alone.
bool is_valid(const Permutation& p) {
    if (!is_grid_permutation(p)) return false;
    const bool heights = p.at("HEIGHT_MEDIA") == MAX_HEIGHT_MEDIA, local = p.at("LOCAL_MEDIA") == 2;
    if (p.at("EPIPOLAR") == 2 && (p.at("HAS_SUN") == 0 || heights != local)) return false;
    return heights || !local;
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

/// `cells_seen`: of the sun's lines by their samples; or empty.
TextureRef add_lines(Frame& frame, const EpipolarPlan& plan, TextureRef table, TextureRef cells_seen) {
    if (plan.lights.empty()) {
        frame.skip("volumetrics/epipolar_lines", "no light in view that casts shadows");
        return {};
    }
    TextureRef nodes = frame.passes.create("volumetrics/epipolar_nodes",
                                           {.format = GL_RG32F, .size = {texels_a_row, rows_of(plan.nodes), 1}});
    const gl::Program& lines = frame.program(lines_program);
    frame.add({.name = "volumetrics/epipolar_lines",
               .program = lines,
               .sources = {{table}, {cells_seen}},
               .images = {{&nodes}},
               .lit = true,
               .draw = [&lines, lights = plan.lights, sampled = static_cast<bool>(cells_seen)] {
                   lines.set("sampled", static_cast<int>(sampled));
                   for (const EpipolarLines& light : lights) {
                       lines.set("light", static_cast<int>(light.index));
                       glDispatchCompute(static_cast<GLuint>(light.lines), 1, 1);
                   }
               }});
    return nodes;
}

const char* const share_passes[] = {"volumetrics/epipolar_sources", "volumetrics/epipolar_walk",
                                    "volumetrics/epipolar_interpolate", "volumetrics/epipolar_unwarp",
                                    "volumetrics/epipolar_fix_up"};

enum class Rays { pixels, samples, pixels_left };  // of epipolar_rays.glsl

/// Adds passes that draw ray_march.frag.
struct March {
    Frame& frame;
    TextureRef table, nodes;

    void add(const std::string& name, Rays rays, const Permutation& own, const std::vector<TextureRef>& more,
             const std::vector<TextureRef*>& targets) {
        const bool local = !frame.media.local.empty();
        const bool heights = local || height_media_axis(frame.media) > 0;
        Permutation permutation{{"EPIPOLAR", 1},
                                {"HEIGHT_MEDIA", heights ? MAX_HEIGHT_MEDIA : 0},
                                {"LOCAL_MEDIA", local ? 2 : 1},
                                {"LAMPS", frame.inputs.has_lamps ? 2 : 0}};
        for (const auto& [axis, value] : own) permutation[axis] = value;
        if (permutation["EPIPOLAR"] == 2 && heights) permutation["LOCAL_MEDIA"] = 2;
        std::vector<Pass::Source> sources{{frame.depth}, {noise_volume(frame), true}, {table}, {nodes}};
        sources.resize(UNIT_EPIPOLAR);
        for (const TextureRef texture : more) sources.push_back({texture});
        frame.add({.name = name,
                   .program = frame.program(program, permutation),
                   .sources = sources,
                   .targets = targets,
                   .lit = true,
                   .light_volumes = true,
                   .local_media = true,
                   .set = [rays, to_pixel = direction_to_pixel(frame.inputs, frame.size),
                           tree = frame.settings.epipolar.tree](const PassContext&, const gl::Program& march) {
                       march.set("rays", static_cast<int>(rays));
                       march.set("to_pixel", to_pixel);
                       march.set("coarsest_level", tree ? 31 : 0);
                   }});
    }
};

/// The steps that give all pixels their shares of sunlight by samples along the sun's lines.
struct Samples {
    Frame& frame;
    const EpipolarLines& sun;
    TextureRef table;
    TextureRef sources = create("epipolar_sources", GL_RG16UI), asked = create("epipolar_asked", GL_RGBA16F),
               interpolated = create("epipolar_samples", GL_RGBA16F);
    TextureRef cells_seen =
        frame.passes.create("volumetrics/epipolar_cells_seen", {.format = GL_R32F, .size = {up(sun.lines), 1, 1}});
    TextureRef unwarped = frame.create("volumetrics/epipolar_unwarped"),
               of_pixels_left = frame.create("volumetrics/epipolar_fixed_up");

    /// The pool keeps what earlier frames had.
    static int up(int n) { return (n + 63) / 64 * 64; }
    [[nodiscard]] TextureRef create(const std::string& name, GLenum format) const {
        return frame.passes.create("volumetrics/" + name,
                                   {.format = format, .size = {up(sun.samples), up(sun.lines), 1}});
    }
    void add(Pass pass) {
        pass.set = [to_pixel = direction_to_pixel(frame.inputs, frame.size), settings = frame.settings.epipolar](
                       const PassContext&, const gl::Program& program) {
            program.set("to_pixel", to_pixel);
            program.set("tolerance", settings.tolerance);
            program.set("sample_step", settings.step);
        };
        frame.add(pass);
    }
    void choose() {
        add({.name = share_passes[0],
             .program = frame.program(sources_program),
             .sources = {{frame.depth}, {table}},
             .images = {{&sources}, {&cells_seen}},
             .groups = {sun.lines, 1, 1}});
    }
    void ask(March& march) {
        const Permutation sun_alone{{"CHROMATIC", 0}, {"LAMPS", 0}};
        march.add(share_passes[1], Rays::samples, sun_alone, {sources}, {&asked});
        add({.name = share_passes[2],
             .program = frame.program(interpolate_program),
             .sources = {{frame.depth}, {table}, {sources}, {asked}},
             .targets = {&interpolated}});
        add({.name = share_passes[3],
             .program = frame.program(unwarp_program),
             .sources = {{frame.depth}, {table}, {interpolated}},
             .targets = {&unwarped}});
        march.add(share_passes[4], Rays::pixels_left, sun_alone, {{}, unwarped}, {&of_pixels_left});
    }
};

Estimate add(Frame& frame) {
    if (!frame.inputs.has_shadow_maps) {
        for (const char* name : {"volumetrics/epipolar_lines", "volumetrics/epipolar"})
            frame.skip(name, "the host has no shaders/interface/shadow_maps.glsl");
        return {};
    }
    const EpipolarPlan plan = plan_epipolar(frame.inputs, frame.settings, frame.size);
    const TextureRef table = upload_table(frame, plan);
    Estimate estimate = frame.create_estimate();
    const std::vector<TextureRef*> targets{&estimate.scattering, &estimate.transmittance};
    if (frame.inputs.has_sun && samples_lines(frame.settings)) {
        Samples samples{frame, plan.lights.front(), table};
        samples.choose();
        March march{frame, table, add_lines(frame, plan, table, samples.cells_seen)};
        samples.ask(march);
        march.add("volumetrics/epipolar", Rays::pixels, {{"EPIPOLAR", 2}},
                  {samples.unwarped, samples.of_pixels_left}, targets);
    } else {
        for (const char* name : share_passes)
            frame.skip(name, frame.inputs.has_sun ? "epipolar_step is 1" : "no sun");
        March march{frame, table, add_lines(frame, plan, table, {})};
        march.add("volumetrics/epipolar", Rays::pixels, {}, {}, targets);
    }
    return estimate;
}

}  // namespace

TechniqueDesc epipolar() {
    return {.name = "epipolar",
            .help = "Marches with shares of light from min/max trees along epipolar lines: sharp, without noise.",
            .settings = "epipolar_",
            .passes = {"volumetrics/epipolar_lines", "volumetrics/noise_volume", "volumetrics/epipolar_sources",
                       "volumetrics/epipolar_walk", "volumetrics/epipolar_interpolate",
                       "volumetrics/epipolar_unwarp", "volumetrics/epipolar_fix_up", "volumetrics/epipolar"},
            .traits = {.sampling = Sampling::exact, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
