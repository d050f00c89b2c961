#include <algorithm>
#include <array>
#include <cmath>

#include "engine/gl/vertex_array.h"
#include "frame/resources.h"
#include "reconstruction/reconstruction.h"
#include "techniques/techniques.h"

// Sunlight as geometry: a mesh of the volume that the sun does not reach, whose faces are blended with the closed
// form of what lies before them (shaders/volumetrics/techniques/shaft_faces.frag); lamps as the cones and spheres
// they light (shaft_resolve.frag).

namespace tyndall::volumetrics {
namespace {

const ProgramDesc mesh_program{.name = "volumetrics/shaft_mesh",
                               .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/shaft_mesh.comp"}},
                               .axes = {{"COUNT_WORK", {0, 1}}},
                               .valid = {}};
const ProgramRegistry::Registration mesh_registration(mesh_program);

const ProgramDesc faces_program{.name = "volumetrics/shaft_faces",
                                .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/shaft_faces.vert"},
                                           {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/shaft_faces.frag"}},
                                .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                         {"HAS_SUN", {1}},
                                         {"CHROMATIC", {0, 1}},
                                         {"COUNT_WORK", {0, 1}}},
                                .valid = {}};
const ProgramRegistry::Registration faces_registration(faces_program);

const ProgramDesc resolve_program{
    .name = "volumetrics/shaft_resolve",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/shaft_resolve.frag"}},
    .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
             {"HAS_SUN", {0, 1}},
             {"LAMPS", {0, 2}},
             {"CHROMATIC", {0, 1}},
             {"PARTS", {0, 1}},  // of lamps, apart
             {"COUNT_WORK", {0, 1}}},
    .valid = [](const Permutation& p) { return p.at("PARTS") == 0 || p.at("LAMPS") != 0; }};
const ProgramRegistry::Registration resolve_registration(resolve_program);

/// `shaft_cuts` of shaft_sun.glsl. One height medium, or homogeneous ones, need no cut. Cuts begin at half of the
/// lowest falloff, and end where a homogeneous medium lets nothing through.
glm::vec4 ray_cuts(const FrameMedia& media, const Settings& settings) {
    constexpr float farthest = 1e9F, opaque = 16;
    const glm::vec4& t = media.data.homogeneous_sigma_t;
    const float clearest = std::min({t.r, t.g, t.b});
    const bool constant =
        std::max({t.r, t.g, t.b}) > 0 || glm::vec3(media.data.homogeneous_emission) != glm::vec3(0);
    const unsigned heights = media.data.height_media_count;
    if (heights == 0 || (heights == 1 && !constant)) return {1, 0, 0, 2 * farthest};
    float falloff = farthest;
    for (unsigned i = 0; i < heights; ++i) falloff = std::min(falloff, media.data.height[i].sigma_t_falloff.w);
    const float first = std::max(0.5F * falloff, 1e-3F);
    const float end = clearest > opaque / farthest ? opaque / clearest : farthest;
    const auto count = static_cast<float>(settings.shaft_geometry.segments);
    return {count, first, std::log1p(end / first) / count, end};
}

TextureRef add_mesh(Frame& frame) {
    const glm::ivec2 size{frame.settings.shaft_geometry.grid + 1, frame.settings.shaft_geometry.grid + 3};
    TextureRef vertices =
        frame.passes.create("volumetrics/shaft_vertices", {.format = GL_RGBA32F, .size = {size, 1}});
    frame.add({.name = "volumetrics/shaft_mesh",
               .program = frame.program(mesh_program),
               .images = {{&vertices}},
               .lit = true,
               .groups = {(size + 7) / 8, 1}});
    return vertices;
}

TextureRef add_faces(Frame& frame, TextureRef vertices) {
    // Sums of large terms of both signs: half floats would lose what remains.
    TextureRef light = frame.create("volumetrics/shaft_light", GL_RGBA32F);
    const auto set = [cuts = ray_cuts(frame.media, frame.settings),
                      relative_to_clip = frame.inputs.projection * glm::mat4(glm::mat3(frame.inputs.view))](
                         const PassContext&, const gl::Program& shader) {
        constexpr std::array<float, 4> black{};
        glClearBufferfv(GL_COLOR, 0, black.data());
        shader.set("relative_to_clip", relative_to_clip);
        shader.set("shaft_cuts", cuts);
    };
    const auto draw = [grid = frame.settings.shaft_geometry.grid] {
        const gl::VertexArray none("volumetrics shaft faces");
        none.bind();
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (grid + 3), grid);
        glBindVertexArray(0);
    };
    frame.add({.name = "volumetrics/shaft_faces",
               .program = frame.program(faces_program),
               .sources = {{vertices}, {frame.depth}},
               .targets = {&light},
               .lit = true,
               // Clamped, not clipped, at the near plane: what lies between it and the eye counts.
               .state = {.blend = gl::Blend::add, .depth_clamp = true},
               .set = set,
               .draw = draw});
    return light;
}

Estimate add_resolve(Frame& frame, TextureRef face_light) {
    Estimate estimate = frame.create_estimate();
    std::vector<TextureRef*> targets{&estimate.scattering, &estimate.transmittance};
    // Of all that is drawn here the lamps' visibility alone has noise.
    const bool lamps = frame.inputs.has_lamps;
    const char* whole = lamps ? reason_for_no_parts(frame.settings) : "no lamps";
    if (whole) {
        frame.skip("volumetrics/relight", whole);
        if (lamps) estimate.sampling = Sampling::per_pixel;
    } else {
        estimate.parts.push_back(
            {.light = frame.create("volumetrics/lamps"), .share = frame.create("volumetrics/lamps_share")});
        targets.insert(targets.end(), {&estimate.parts[0].light, &estimate.parts[0].share});
    }
    frame.add(
        {.name = "volumetrics/shaft_resolve",
         .program = frame.program(resolve_program, {{"LAMPS", lamps ? 2 : 0}, {"PARTS", whole == nullptr}}),
         .sources = {{frame.depth}, {face_light}},
         .targets = targets,
         .lit = true,
         .set = [cuts = ray_cuts(frame.media, frame.settings), parts = frame.settings.shaft_geometry.lamp_parts](
                    const PassContext&, const gl::Program& shader) {
             shader.set("shaft_cuts", cuts);
             shader.set("shaft_lamp_parts", parts);
         }});
    return estimate;
}

Estimate add(Frame& frame) {
    TextureRef light;
    if (frame.inputs.has_sun)
        light = add_faces(frame, add_mesh(frame));
    else
        for (const char* name : {"volumetrics/shaft_mesh", "volumetrics/shaft_faces"}) frame.skip(name, "no sun");
    return add_resolve(frame, light);
}

}  // namespace

TechniqueDesc shaft_geometry() {
    return {.name = "shaft_geometry",
            .help = "Meshes the sun's shadows and blends closed forms at their faces; no local media.",
            .settings = "shaft_",
            .passes = {"volumetrics/shaft_mesh", "volumetrics/shaft_faces", "volumetrics/shaft_resolve"},
            .traits = {.sampling = Sampling::per_pixel,
                       .any_resolution = true,
                       .glass = false,
                       .needs_global_medium = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
