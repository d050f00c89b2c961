#include "frame/resources.h"
#include "media/noise_volume.h"
#include "reconstruction/reconstruction.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sprites.h"
#include "techniques/particle_batches.h"
#include "techniques/sprites.h"
#include "techniques/techniques.h"

// See shaders/volumetrics/techniques/particles_simulate.comp, particles.frag and particles_resolve.frag.
namespace tyndall::volumetrics {
namespace {

const PermutationAxis has_sun{"HAS_SUN", {0, 1}}, global_media{"GLOBAL_MEDIA", {0, 1}},
    local_media{"LOCAL_MEDIA", {0, 1}}, grids{"GRIDS", {0, 1}}, chromatic_axis{"CHROMATIC", {0, 1}},
    count_work{"COUNT_WORK", {0, 1}};

bool has_media(const Permutation& p) {
    return p.at("GLOBAL_MEDIA") != 0 || p.at("LOCAL_MEDIA") != 0;
}

const ProgramDesc simulate_program{
    .name = "volumetrics/particles_simulate",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/particles_simulate.comp"}},
    .axes = {has_sun,
             {"LAMPS", {0, 2}},  // 2: over a segment, as LampIntegration::segment
             {"LIGHT_VOLUMES", {0, 1, 2}},
             grids,
             {"GLASS", {0, 1, 2, 3}},
             count_work},
    .valid = [](const Permutation& p) { return is_light_volume_permutation(p) && is_glass_permutation(p); }};
const ProgramDesc draw_program{.name = "volumetrics/particles",
                               .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/particles.vert"},
                                          {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/particles.frag"}},
                               .axes = {global_media, local_media, chromatic_axis, count_work},
                               .valid = has_media};
const ProgramDesc resolve_program{
    .name = "volumetrics/particles_resolve",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/particles_resolve.frag"}},
    .axes = {global_media, local_media, grids, has_sun, chromatic_axis, count_work},
    .valid = [](const Permutation& p) { return has_media(p) && is_grid_permutation(p); }};
const ProgramRegistry::Registration simulate_registration(simulate_program), draw_registration(draw_program),
    resolve_registration(resolve_program);

/// World to clip of points relative to the eye.
glm::mat4 view_projection(const Inputs& inputs) {
    return inputs.projection * glm::mat4(glm::mat3(inputs.view));
}

void dispatch(const gl::Program& shader, const ParticleBatch& batch) {
    shader.set("medium", batch.medium);
    shader.set("first", batch.first);
    shader.set("count", batch.count);
    shader.set("radius", batch.radius);
    shader.set("volume", batch.volume);
    shader.set("side", batch.side);
    shader.set("lower_cell", batch.lower_cell);
    shader.set("lower_corner", batch.lower_corner);
    shader.set("spacing", batch.spacing);
    shader.set("reach", batch.reach);
    shader.set("drift", batch.drift);
    shader.set("placement", batch.placement);
    glDispatchCompute((batch.count + 63) / 64, 1, 1);
}

BufferRef add_simulate(Frame& frame, gl::Buffer& sprites, std::vector<ParticleBatch> batches) {
    const std::size_t bytes = (batches.back().first + batches.back().count) * sizeof(shared::ParticleSprite);
    if (sprites.size() != bytes) sprites = gl::Buffer(bytes, "volumetrics particles");
    BufferRef particles = frame.passes.import_buffer("volumetrics/particles", sprites.id());
    const gl::Program& shader = frame.program(simulate_program, {{"LAMPS", frame.inputs.has_lamps ? 2 : 0}});
    frame.add(
        {.name = "volumetrics/particles_simulate",
         .program = shader,
         .written = {&particles},
         .lit = true,
         .light_volumes = true,
         .local_media = true,
         .set =
             [&sprites, matrix = view_projection(frame.inputs)](const PassContext&, const gl::Program& program) {
                 sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
                 program.set("view_projection", matrix);
             },
         .draw =
             [&shader, batches = std::move(batches)] {
                 for (const ParticleBatch& batch : batches) dispatch(shader, batch);
             }});
    return particles;
}

/// Sums over the particles of each pixel, see the shaders; RGBA32F, for many are added. What is certain of coloured
/// extinction is apart.
struct Sums {
    TextureRef global, global_certain, local, local_certain;
};

Sums add_draw(Frame& frame, const gl::Buffer& sprites, BufferRef particles, GLsizei count) {
    const bool global = frame.media.has_global, local = !frame.media.local.empty();
    Sums sums;
    const bool chromatic = frame.media.chromatic;
    if (global) sums.global = frame.create("volumetrics/particles_global", GL_RGBA32F);
    if (local) sums.local = frame.create("volumetrics/particles_local", GL_RGBA32F);
    if (global && chromatic) sums.global_certain = frame.create("volumetrics/particles_global_certain", GL_RGBA32F);
    if (local && chromatic) sums.local_certain = frame.create("volumetrics/particles_local_certain", GL_RGBA32F);
    const bool hides = is_depth_buffer(frame);
    frame.add({.name = "volumetrics/particles",
               .program = frame.program(draw_program, {{"GLOBAL_MEDIA", global}}),
               .sources = {{frame.depth}},
               .buffers = {particles},
               .targets = {&sums.global, &sums.global_certain, &sums.local, &sums.local_certain},
               .depth_test = hides ? frame.depth : TextureRef{},
               .state = {.depth_test = hides, .blend = gl::Blend::add},
               .set =
                   [&sprites, targets = (static_cast<int>(global) + static_cast<int>(local)) * (chromatic ? 2 : 1),
                    matrix = view_projection(frame.inputs),
                    near = frame.inputs.znear](const PassContext&, const gl::Program& shader) {
                       const glm::vec4 nothing{0};
                       for (GLint target = 0; target < targets; ++target)
                           glClearBufferfv(GL_COLOR, target, &nothing.x);
                       sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
                       shader.set("view_projection", matrix);
                       shader.set("near", near);
                   },
               .draw = [count] { draw_sprites(count); }});
    return sums;
}

Estimate add(Frame& frame) {
    Estimate estimate = frame.create_estimate();
    estimate.sampling = Sampling::per_frame;
    gl::Buffer& sprites = frame.kept<Sprites>().buffer;
    std::vector<ParticleBatch> batches = particle_batches(frame.inputs, frame.settings, frame.media);
    const auto count = static_cast<GLsizei>(batches.back().first + batches.back().count);
    const BufferRef particles = add_simulate(frame, sprites, std::move(batches));
    const Sums sums = add_draw(frame, sprites, particles, count);
    frame.add({.name = "volumetrics/particles_resolve",
               .program = frame.program(resolve_program, {{"GLOBAL_MEDIA", frame.media.has_global}}),
               .sources = {{frame.depth},
                           {noise_volume(frame), true},
                           {sums.global},
                           {sums.local},
                           {},  // grids
                           {},
                           {sums.global_certain},
                           {sums.local_certain}},
               .targets = {&estimate.scattering, &estimate.transmittance},
               .lit = true,
               .local_media = true,
               .set = [reach = particle_reach(frame.settings)](const PassContext&, const gl::Program& shader) {
                   shader.set("reach", reach);
               }});
    return estimate;
}

}  // namespace

TechniqueDesc particles() {
    return {.name = "particles",
            .help = "Draws the media as drifting sprites, each lit once; local media soft by a sprite's radius.",
            .settings = "particle_",
            .passes = {"volumetrics/noise_volume", "volumetrics/particles_simulate", "volumetrics/particles",
                       "volumetrics/particles_resolve"},
            .traits = {.sampling = Sampling::per_frame, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
