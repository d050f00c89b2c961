#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/reconstruction.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sprites.h"
#include "techniques/particle_batches.h"

// See shaders/volumetrics/techniques/particles_simulate.comp, particles.frag and particles_resolve.frag.
namespace tyndall::volumetrics {
namespace {

const PermutationAxis has_sun{"HAS_SUN", {0, 1}}, global_media{"GLOBAL_MEDIA", {0, 1}},
    local_media{"LOCAL_MEDIA", {0, 1}}, chromatic{"CHROMATIC", {0, 1}}, count_work{"COUNT_WORK", {0, 1}};

bool has_media(const Permutation& p) {
    return p.at("GLOBAL_MEDIA") != 0 || p.at("LOCAL_MEDIA") != 0;
}

const ProgramDesc simulate_program{
    .name = "volumetrics/particles_simulate",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/particles_simulate.comp"}},
    .axes = {has_sun,
             {"LAMPS", {0, 2}},  // 2: over a segment, as LampIntegration::segment
             {"LIGHT_VOLUMES", {0, 1}},
             count_work},
    .valid = is_light_volume_permutation};
const ProgramDesc draw_program{.name = "volumetrics/particles",
                               .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/particles.vert"},
                                          {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/particles.frag"}},
                               .axes = {global_media, local_media, count_work},
                               .valid = has_media};
const ProgramDesc resolve_program{
    .name = "volumetrics/particles_resolve",
    .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/particles_resolve.frag"}},
    .axes = {global_media, local_media, has_sun, chromatic, count_work},
    .valid = has_media};
const ProgramRegistry::Registration simulate_registration(simulate_program), draw_registration(draw_program),
    resolve_registration(resolve_program);

/// World to clip of points relative to the eye.
glm::mat4 view_projection(const Inputs& inputs) {
    return inputs.projection * glm::mat4(glm::mat3(inputs.view));
}

bool is_lit(const Inputs& inputs) {
    return inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
}

void use_lights(PassBuilder& builder, const Inputs& inputs) {
    if (!is_lit(inputs)) return;
    for (TextureRef texture : inputs.light_textures) builder.sample(texture);
    for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
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

BufferRef add_simulate(PassList& passes, PassResources& resources, const Inputs& inputs, const FrameMedia& media,
                       std::vector<ParticleBatch> batches) {
    const std::size_t bytes = (batches.back().first + batches.back().count) * sizeof(shared::Particle);
    if (resources.sprites.size() != bytes) resources.sprites = gl::Buffer(bytes, "volumetrics particles");
    BufferRef particles = passes.import_buffer("volumetrics/particles", resources.sprites.id());
    const gl::Program& shader =
        resources.shaders.get(simulate_program, {{"HAS_SUN", inputs.has_sun},
                                                 {"LAMPS", inputs.has_lamps ? 2 : 0},
                                                 {"LIGHT_VOLUMES", resources.light_volumes.any()},
                                                 {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/particles_simulate",
        [&](PassBuilder& builder) {
            use_lights(builder, inputs);
            resources.light_volumes.sample(builder);
            particles = builder.write(particles);
        },
        [batches = std::move(batches), matrix = view_projection(inputs), has_global = media.has_global,
         bind_lighting = is_lit(inputs) ? inputs.bind_lighting : nullptr, &shader, &resources](const PassContext&) {
            if (bind_lighting) bind_lighting();
            resources.light_volumes.bind();
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
            if (resources.local_media) resources.local_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
            shader.set("view_projection", matrix);
            shader.set("has_global", has_global ? 1 : 0);
            shader.use();
            for (const ParticleBatch& batch : batches) dispatch(shader, batch);
        });
    return particles;
}

/// Sums over the particles of each pixel, see the shaders; RGBA32F, for many are added.
struct Sums {
    TextureRef global, local, local_depth;
};

Sums add_draw(PassList& passes, const PassResources& resources, const Inputs& inputs, const FrameMedia& media,
              BufferRef particles, GLsizei count) {
    const gl::TextureDesc desc{.format = GL_RGBA32F, .size = {inputs.size, 1}};
    const bool local = !media.local.empty();
    const bool hides = is_depth_buffer(passes, inputs);
    Sums sums;
    if (media.has_global) sums.global = passes.create("volumetrics/particles_global", desc);
    if (local) sums.local = passes.create("volumetrics/particles_local", desc);
    if (local) sums.local_depth = passes.create("volumetrics/particles_local_depth", desc);
    const gl::Program& shader = resources.shaders.get(
        draw_program,
        {{"GLOBAL_MEDIA", media.has_global}, {"LOCAL_MEDIA", local}, {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/particles",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.read(particles);
            for (TextureRef* sum : {&sums.global, &sums.local, &sums.local_depth})
                if (*sum) *sum = builder.attach_color(*sum);
            if (hides) builder.attach_depth_read_only(inputs.depth);
        },
        [hides, depth = inputs.depth, targets = static_cast<int>(media.has_global) + 2 * static_cast<int>(local),
         count, matrix = view_projection(inputs), near = inputs.znear, &shader,
         &resources](const PassContext& context) {
            gl::apply({.depth_test = hides, .blend = gl::Blend::add});
            context.bind_framebuffer();
            const glm::vec4 nothing{0};
            for (GLint target = 0; target < targets; ++target) glClearBufferfv(GL_COLOR, target, &nothing.x);
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
            shader.set("view_projection", matrix);
            shader.set("near", near);
            shader.use();
            const gl::VertexArray empty("particles");
            empty.bind();
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
            glBindVertexArray(0);
        });
    return sums;
}

Outputs create_outputs(PassList& passes, const Inputs& inputs, const FrameMedia& media) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    Outputs outputs;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);
    return outputs;
}

void add_resolve(PassList& passes, const PassResources& resources, const Inputs& inputs, const Settings& settings,
                 const FrameMedia& media, const Sums& sums, Outputs& outputs) {
    const gl::Program& shader = resources.shaders.get(resolve_program, {{"GLOBAL_MEDIA", media.has_global},
                                                                        {"LOCAL_MEDIA", !media.local.empty()},
                                                                        {"HAS_SUN", inputs.has_sun},
                                                                        {"CHROMATIC", media.chromatic},
                                                                        {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/particles_resolve",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(sums.global);
            builder.sample(sums.local);
            builder.sample(sums.local_depth);
            use_lights(builder, inputs);
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (outputs.transmittance) outputs.transmittance = builder.attach_color(outputs.transmittance);
        },
        [sums, depth = inputs.depth, bind_lighting = is_lit(inputs) ? inputs.bind_lighting : nullptr,
         reach = particle_reach(settings), &shader, &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{texture(depth), resources.nearest},
                                      {texture(sums.global), resources.nearest},
                                      {texture(sums.local), resources.nearest},
                                      {texture(sums.local_depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.set("reach", reach);
            shader.use();
            gl::draw_fullscreen();
        });
}

}  // namespace

Outputs add_particles(PassList& passes, PassResources& resources, const Inputs& inputs, const Settings& settings,
                      const FrameMedia& media) {
    Outputs outputs = create_outputs(passes, inputs, media);
    std::vector<ParticleBatch> batches = particle_batches(inputs, settings, media);
    const auto count = static_cast<GLsizei>(batches.back().first + batches.back().count);
    const BufferRef particles = add_simulate(passes, resources, inputs, media, std::move(batches));
    const Sums sums = add_draw(passes, resources, inputs, media, particles, count);
    add_resolve(passes, resources, inputs, settings, media, sums, outputs);
    return outputs;
}

}  // namespace tyndall::volumetrics
