#include "techniques/epipolar_sunlight.h"

#include "engine/gl/vertex_array.h"
#include "frame/resources.h"
#include "media/noise_volume.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc choose_program{.name = "volumetrics/epipolar_choose",
                                 .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/light/epipolar_choose.comp"}},
                                 .axes = {},
                                 .valid = {}};
const ProgramRegistry::Registration choose_registration(choose_program);

const ProgramDesc interpolate_program{
    .name = "volumetrics/epipolar_interpolate",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/light/epipolar_interpolate.frag"}},
    .axes = {{"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration interpolate_registration(interpolate_program);

const ProgramDesc unwarp_program{.name = "volumetrics/epipolar_unwarp",
                                 .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                            {GL_FRAGMENT_SHADER, "shaders/volumetrics/light/epipolar_unwarp.frag"}},
                                 .axes = {{"COUNT_WORK", {0, 1}}},
                                 .valid = {}};
const ProgramRegistry::Registration unwarp_registration(unwarp_program);

const ProgramDesc march_program{.name = "volumetrics/epipolar_march",
                                .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/light/epipolar_rays.vert"},
                                           {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                                .axes = {{"EPIPOLAR", {1}},
                                         {"SUN_ALONE", {1}},
                                         {"HEIGHT_MEDIA", {0, MAX_HEIGHT_MEDIA}},
                                         {"LOCAL_MEDIA", {1, 2}},
                                         {"GRIDS", {0, 1}},
                                         {"HAS_SUN", {1}},
                                         {"LAMPS", {0}},
                                         {"CHROMATIC", {0, 1}},
                                         {"COUNT_WORK", {0, 1}}},
                                .valid = is_epipolar_permutation};
const ProgramRegistry::Registration march_registration(march_program);

constexpr int lines_together = 4, tile = 16;  // of epipolar_rays.vert

/// The pool keeps what earlier frames had.
int round_up(int n) {
    constexpr int block = 64;
    return (n + block - 1) / block * block;
}

}  // namespace

const std::vector<std::string>& epipolar_sunlight_passes() {
    static const std::vector<std::string> names{"volumetrics/epipolar_choose", "volumetrics/epipolar_walk",
                                                "volumetrics/epipolar_interpolate", "volumetrics/epipolar_unwarp",
                                                "volumetrics/epipolar_fix_up"};
    return names;
}

bool is_epipolar_permutation(const Permutation& p) {
    return is_grid_permutation(p) && (p.at("HEIGHT_MEDIA") == MAX_HEIGHT_MEDIA || p.at("LOCAL_MEDIA") == 1);
}

Permutation epipolar_permutation(const Frame& frame) {
    const bool local = !frame.media.local.empty();
    const bool heights = local || height_media_axis(frame.media) > 0;
    return {{"HEIGHT_MEDIA", heights ? MAX_HEIGHT_MEDIA : 0}, {"LOCAL_MEDIA", local ? 2 : 1}};
}

EpipolarSunlight::EpipolarSunlight(Frame& frame, const EpipolarLines& sun, TextureRef table)
    : frame_(frame), sun_(sun), table_(table) {
    counts = frame.passes.create("volumetrics/epipolar_counts",
                                 {.format = GL_RG32F, .size = {round_up(sun.lines), 1, 1}});
    between_ = create("epipolar_between", GL_RG16UI);
    asking_ = create("epipolar_asking", GL_R16UI);
    add({.name = "volumetrics/epipolar_choose",
         .program = frame.program(choose_program),
         .sources = {{frame.depth}, {table}},
         .images = {{&between_}, {&asking_}, {&counts}},
         .groups = {round_up(sun.lines), 1, 1}});
}

void EpipolarSunlight::add_passes(TextureRef nodes) {
    asked_ = create("epipolar_asked", GL_RGBA16F);
    march("volumetrics/epipolar_walk", nodes, asking_, counts, asked_, round_up(sun_.lines) / lines_together);
    interpolated_ = create("epipolar_samples", GL_RGBA16F);
    add({.name = "volumetrics/epipolar_interpolate",
         .program = frame_.program(interpolate_program),
         .sources = {{frame_.depth}, {table_}, {between_}, {asking_}, {asked_}},
         .targets = {&interpolated_}});
    unwarped = frame_.create("volumetrics/epipolar_unwarped");
    add({.name = "volumetrics/epipolar_unwarp",
         .program = frame_.program(unwarp_program),
         .sources = {{frame_.depth}, {table_}, {interpolated_}},
         .targets = {&unwarped}});
    fixed_up = frame_.create("volumetrics/epipolar_fixed_up");
    const glm::ivec2 tiles = (frame_.size + tile - 1) / tile;
    march("volumetrics/epipolar_fix_up", nodes, {}, unwarped, fixed_up, tiles.x * tiles.y);
}

TextureRef EpipolarSunlight::create(const std::string& name, GLenum format) const {
    return frame_.passes.create("volumetrics/" + name,
                                {.format = format, .size = {round_up(sun_.samples), round_up(sun_.lines), 1}});
}

void EpipolarSunlight::add(Pass pass) {
    pass.set = [to_pixel = direction_to_pixel(frame_.inputs, frame_.size), settings = frame_.settings.epipolar](
                   const PassContext&, const gl::Program& program) {
        program.set("to_pixel", to_pixel);
        program.set("tolerance", settings.tolerance);
        program.set("sample_step", settings.step);
    };
    frame_.add(pass);
}

/// Of samples, where `asking` says which; else of pixels.
void EpipolarSunlight::march(const std::string& name, TextureRef nodes, TextureRef asking, TextureRef wanted,
                             TextureRef& target, int rectangles) {
    Permutation permutation = epipolar_permutation(frame_);
    permutation.insert({{"EPIPOLAR", 1}, {"SUN_ALONE", 1}, {"LAMPS", 0}});
    frame_.add(
        {.name = name,
         .program = frame_.program(march_program, permutation),
         .sources = {{frame_.depth}, {noise_volume(frame_), true}, {table_}, {nodes}, {}, {}, {asking}, {wanted}},
         .targets = {&target},
         .lit = true,
         .light_volumes = true,
         .local_media = true,
         .set =
             [of_samples = static_cast<bool>(asking), tree = frame_.settings.epipolar.tree,
              to_pixel = direction_to_pixel(frame_.inputs, frame_.size),
              size = glm::ivec2(frame_.passes.desc(target).size)](const PassContext&, const gl::Program& p) {
                 p.set("of_samples", static_cast<int>(of_samples));
                 p.set("coarsest_level", coarsest_epipolar_level(tree));
                 p.set("to_pixel", to_pixel);
                 p.set("target", size);
             },
         .draw =
             [rectangles] {
                 const gl::VertexArray none("volumetrics epipolar rays");
                 none.bind();
                 glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, rectangles);
                 glBindVertexArray(0);
             }});
}

}  // namespace tyndall::volumetrics
