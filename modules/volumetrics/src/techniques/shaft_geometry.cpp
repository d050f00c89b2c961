#include <algorithm>
#include <array>
#include <cmath>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/relight.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"

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
             {"VISIBILITY", {0, 1}},  // of lamps, apart
             {"COUNT_WORK", {0, 1}}},
    .valid = [](const Permutation& p) { return p.at("VISIBILITY") == 0 || p.at("LAMPS") != 0; }};
const ProgramRegistry::Registration resolve_registration(resolve_program);

void read_lighting(PassBuilder& builder, const Inputs& inputs) {
    for (TextureRef texture : inputs.light_textures) builder.sample(texture);
    for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
}

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
    const auto count = static_cast<float>(settings.shaft_segments);
    return {count, first, std::log1p(end / first) / count, end};
}

TextureRef add_mesh(PassList& passes, const PassResources& resources, const Inputs& inputs,
                    const Settings& settings) {
    const glm::ivec2 size{settings.shaft_grid + 1, settings.shaft_grid + 3};
    TextureRef vertices = passes.create("volumetrics/shaft_vertices", {.format = GL_RGBA32F, .size = {size, 1}});
    const gl::Program& shader = resources.shaders.get(mesh_program, {{"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/shaft_mesh",
        [&](PassBuilder& builder) {
            read_lighting(builder, inputs);
            vertices = builder.storage_write(vertices);
        },
        [vertices, groups = (size + 7) / 8, bind_lighting = inputs.bind_lighting, &shader,
         &resources](const PassContext& context) {
            if (bind_lighting) bind_lighting();
            glBindImageTexture(0, context.texture(vertices).id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.use();
            glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y), 1);
        });
    return vertices;
}

TextureRef add_faces(PassList& passes, const PassResources& resources, const Inputs& inputs,
                     const Settings& settings, const FrameMedia& media, TextureRef vertices) {
    // Sums of large terms of both signs: half floats would lose what remains.
    TextureRef light = passes.create("volumetrics/shaft_light", {.format = GL_RGBA32F, .size = {inputs.size, 1}});
    const gl::Program& shader = resources.shaders.get(faces_program, {{"HEIGHT_MEDIA", height_media_axis(media)},
                                                                      {"HAS_SUN", 1},
                                                                      {"CHROMATIC", media.chromatic},
                                                                      {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/shaft_faces",
        [&](PassBuilder& builder) {
            builder.sample(vertices);
            builder.sample(inputs.depth);
            read_lighting(builder, inputs);
            light = builder.attach_color(light);
        },
        [vertices, depth = inputs.depth, cuts = ray_cuts(media, settings), grid = settings.shaft_grid,
         relative_to_clip = inputs.projection * glm::mat4(glm::mat3(inputs.view)),
         bind_lighting = inputs.bind_lighting, &shader, &resources](const PassContext& context) {
            // Clamped, not clipped, at the near plane: what lies between it and the eye counts.
            gl::apply({.blend = gl::Blend::add, .depth_clamp = true});
            context.bind_framebuffer();
            constexpr std::array<float, 4> black{};
            glClearBufferfv(GL_COLOR, 0, black.data());
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{context.texture(vertices), resources.nearest},
                                      {context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.set("relative_to_clip", relative_to_clip);
            shader.set("shaft_cuts", cuts);
            shader.use();
            const gl::VertexArray none("volumetrics shaft faces");
            none.bind();
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (grid + 3), grid);
            glBindVertexArray(0);
        });
    return light;
}

MarchedLight add_resolve(PassList& passes, const PassResources& resources, const Inputs& inputs,
                         const Settings& settings, const FrameMedia& media, TextureRef face_light) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    MarchedLight marched;
    Outputs& outputs = marched.rest;
    Relit& lamps = marched.lamps;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);
    // Of all that is drawn here the lamps' visibility alone has noise.
    if (const char* whole = inputs.has_lamps ? reason_for_light(settings) : "no lamps")
        passes.skip("volumetrics/relight", whole);
    else
        lamps = {passes.create("volumetrics/lamps", desc), passes.create("volumetrics/lamps_share", desc)};
    const gl::Program& shader = resources.shaders.get(resolve_program, {{"HEIGHT_MEDIA", height_media_axis(media)},
                                                                        {"HAS_SUN", inputs.has_sun},
                                                                        {"LAMPS", inputs.has_lamps ? 2 : 0},
                                                                        {"CHROMATIC", media.chromatic},
                                                                        {"VISIBILITY", static_cast<bool>(lamps)},
                                                                        {"COUNT_WORK", inputs.count_work}});
    const bool lit = inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
    passes.add(
        "volumetrics/shaft_resolve",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(face_light);
            if (lit) read_lighting(builder, inputs);
            outputs.scattering = builder.attach_color(outputs.scattering);
            for (TextureRef* ref : {&outputs.transmittance, &lamps.light, &lamps.share})
                if (*ref) *ref = builder.attach_color(*ref);
        },
        [face_light, depth = inputs.depth, cuts = ray_cuts(media, settings), parts = settings.shaft_lamp_parts,
         bind_lighting = lit ? inputs.bind_lighting : nullptr, &shader, &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{
                {context.texture(depth), resources.nearest},
                {face_light ? context.texture(face_light) : gl::TextureView(), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.noise.bind();
            shader.set("shaft_cuts", cuts);
            shader.set("shaft_lamp_parts", parts);
            shader.use();
            gl::draw_fullscreen();
        });
    return marched;
}

}  // namespace

MarchedLight add_shaft_geometry(PassList& passes, PassResources& resources, const Inputs& inputs,
                                const Settings& settings, const FrameMedia& media) {
    TextureRef light;
    if (inputs.has_sun)
        light =
            add_faces(passes, resources, inputs, settings, media, add_mesh(passes, resources, inputs, settings));
    else
        for (const char* name : {"volumetrics/shaft_mesh", "volumetrics/shaft_faces"}) passes.skip(name, "no sun");
    return add_resolve(passes, resources, inputs, settings, media, light);
}

}  // namespace tyndall::volumetrics
