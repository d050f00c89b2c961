#include "engine/render/passes/transparent.h"

#include <algorithm>

#include "engine/gl/state.h"
#include "engine/render/passes/material_binding.h"
#include "engine/scene/particles.h"
#include "shaders/shared/bindings.h"

namespace tyndall {
namespace {

const std::vector<PermutationAxis> axes{{"HAS_SUN", {0, 1}},          {"HAS_LAMPS", {0, 1}},
                                        {"SHADOWS", {0, 1}},          {"MEDIUM_TRANSMITTANCE", {0, 1}},
                                        {"LIGHT_VOLUMES", {0, 1, 2}}, {"FOG", {0, 1}},
                                        {"SKY_VISIBILITY", {0, 1}},   {"COUNT_WORK", {0, 1}}};

bool is_permutation(const Permutation& p) {
    const int volumes = p.at("LIGHT_VOLUMES");
    if (volumes != 0 && p.at("MEDIUM_TRANSMITTANCE") == 0) return false;
    if (volumes == 2 && p.at("HAS_SUN") == 0) return false;
    // Media that are not in view are local ones.
    if (p.at("MEDIUM_TRANSMITTANCE") != 0 && p.at("FOG") == 0 && volumes == 0) return false;
    const bool lights = p.at("HAS_SUN") != 0 || p.at("HAS_LAMPS") != 0;
    return lights || (p.at("SHADOWS") == 0 && p.at("MEDIUM_TRANSMITTANCE") == 0);
}

const ProgramDesc surface_program{.name = "transparent",
                                  .stages = {{GL_VERTEX_SHADER, "shaders/engine/gbuffer.vert"},
                                             {GL_FRAGMENT_SHADER, "shaders/engine/transparent.frag"}},
                                  .axes = axes,
                                  .valid = is_permutation};
const ProgramDesc particle_program{.name = "particles",
                                   .stages = {{GL_VERTEX_SHADER, "shaders/engine/particles.vert"},
                                              {GL_FRAGMENT_SHADER, "shaders/engine/particles.frag"}},
                                   .axes = axes,
                                   .valid = is_permutation};
const ProgramRegistry::Registration registrations[] = {ProgramRegistry::Registration(surface_program),
                                                       ProgramRegistry::Registration(particle_program)};

Permutation permutation(const FrameContext& frame, const LightSources& sources,
                        std::span<const FrameModule::Transparents> modules) {
    Permutation defines = sources.defines;
    for (const FrameModule::Transparents& module : modules)
        defines.insert(module.defines.begin(), module.defines.end());
    const bool lamps = frame.facts.local_lights_in_view > 0, lights = frame.facts.has_sun || lamps;
    defines.merge(Permutation{{"HAS_SUN", frame.facts.has_sun},
                              {"HAS_LAMPS", lamps},
                              {"SHADOWS", frame.settings.shadows && lights},
                              {"MEDIUM_TRANSMITTANCE", 0},
                              {"LIGHT_VOLUMES", 0},
                              {"FOG", 0},
                              {"SKY_VISIBILITY", frame.facts.sky_visibility},
                              {"COUNT_WORK", frame.count_work}});
    return defines;
}

/// Of something to be drawn: an entry of GpuScene::instances() or of a list of particles.
struct Item {
    float view_depth;
    bool particle;
    std::uint32_t index;
};

shared::Particle pack(const Particle& p, float light_unit) {
    return {.position_radius = {p.position, p.radius},
            .color_opacity = {p.color, p.opacity},
            .emission_seed = {p.emission / light_unit, p.random}};
}

bool is_near(const FrameContext& frame, int node, glm::vec3 point) {
    const float farthest = frame.scene.nodes[static_cast<std::size_t>(node)].draw_distance;
    return farthest <= 0 || glm::distance(point, frame.view.eye) <= farthest;
}

constexpr float faintest_opacity = 0.002f;

}  // namespace

void TransparentPass::gather(const FrameContext& frame) {
    draws_.clear();
    bounds_.clear();
    instances_.clear();
    particles_.clear();
    const Frustum frustum = Frustum::from(frame.view.view_projection);
    const auto view_depth = [&](glm::vec3 p) { return -(frame.view.view * glm::vec4(p, 1)).z; };
    std::vector<Item> items;
    for (std::size_t i = 0; i < frame.gpu.instances().size(); ++i) {
        const Instance& instance = frame.gpu.instances()[i];
        const glm::vec3 middle = 0.5f * (instance.bounds.min + instance.bounds.max);
        if (!frame.gpu.material(instance.material).alpha_blend || !is_near(frame, instance.node, middle) ||
            !frustum.intersects(instance.bounds))
            continue;
        items.push_back({view_depth(middle), false, static_cast<std::uint32_t>(i)});
        bounds_.push_back(instance.bounds);
    }
    std::vector<Particle> particles;
    for (const ParticleEmitter& emitter : frame.scene.emitters) {
        const glm::mat4& world = frame.scene.nodes[static_cast<std::size_t>(emitter.node)].world;
        if (is_near(frame, emitter.node, glm::vec3(world[3])))
            append_particles(emitter, world, frame.time, particles);
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Particle& p = particles[i];
        const float reach = 1.5f * p.radius;
        if (p.opacity < faintest_opacity || !frustum.intersects_sphere(p.position, reach)) continue;
        bounds_.push_back({p.position - reach, p.position + reach});
        items.push_back({view_depth(p.position), true, static_cast<std::uint32_t>(i)});
    }
    std::ranges::stable_sort(items, std::greater(), &Item::view_depth);
    for (const Item& item : items) {
        const std::size_t first = item.particle ? particles_.size() : instances_.size();
        const bool joins = item.particle && !draws_.empty() && draws_.back().particles;
        if (joins)
            ++draws_.back().count;
        else
            draws_.push_back({item.particle, static_cast<std::uint32_t>(first), 1});
        if (item.particle)
            particles_.push_back(pack(particles[item.index], frame.scene.light_unit()));
        else
            instances_.push_back(frame.gpu.drawn(item.index));
    }
}

TextureRef TransparentPass::add(FrameContext& frame, const GBuffer& g, const LightSources& sources,
                                std::span<FrameModule* const> modules, TextureRef color) {
    if (draws_.empty()) {
        frame.passes.skip("transparent", "nothing transparent in view");
        drawn_ = {};
        particle_buffer_ = {};
        return color;
    }
    if (!no_vertices_.id()) no_vertices_ = gl::VertexArray("particles");
    drawn_.assign(std::span<const GpuScene::DrawnInstance>(instances_), "transparent instances");
    particle_buffer_.assign(std::span<const shared::Particle>(particles_), "particles");
    std::vector<FrameModule::Transparents> additions;
    for (const FrameModule* module : modules) additions.push_back(module->transparents());
    frame.passes.add(
        "transparent",
        [&](PassBuilder& pass) {
            pass.sample(sources.sky);
            for (TextureRef texture : sources.textures) pass.sample(texture);
            for (BufferRef buffer : sources.buffers) pass.read(buffer);
            for (const FrameModule::Transparents& addition : additions)
                if (addition.declare) addition.declare(pass);
            pass.sample(g.depth);
            color = pass.attach_color(color);
            pass.attach_depth_read_only(g.depth);
        },
        [this, &frame, &sources, additions, depth = g.depth](const PassContext& pass) {
            pass.bind_framebuffer();
            sources.bind();
            for (const FrameModule::Transparents& addition : additions)
                if (addition.bind) addition.bind(pass);
            glBindSamplers(0, 6, nullptr);
            glBindTextureUnit(5, sources.sky ? pass.texture(sources.sky).id : 0);
            const Permutation p = permutation(frame, sources, additions);
            const gl::Program& surfaces = frame.shaders.get(surface_program, p);
            const gl::Program& particles = frame.shaders.get(particle_program, p);
            const GLuint depth_texture = pass.texture(depth).id;
            for (const Draw& d : draws_) {
                if (!d.particles) {
                    draw_instance(frame, surfaces, d.first);
                    continue;
                }
                gl::apply({.depth_test = true, .blend = gl::Blend::over});
                glBindTextureUnit(0, depth_texture);
                no_vertices_.bind();
                particle_buffer_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_PARTICLES);
                particles.use();
                glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(d.count), d.first);
            }
        });
    return color;
}

void TransparentPass::draw_instance(const FrameContext& frame, const gl::Program& shader,
                                    std::uint32_t index) const {
    const Instance& instance = frame.gpu.instances()[instances_[index].instance];
    const GpuScene::GpuMaterial& material = frame.gpu.material(instance.material);
    const GpuScene::MeshRange& range = frame.gpu.range(instance.mesh);
    frame.gpu.bind(drawn_);
    shader.set("transmission", material.transmission);
    bind_material(shader, material, instance.mirrored, frame.scene.light_unit());
    const auto draw_faces = [&](GLenum cull) {
        gl::apply({.depth_test = true, .cull = cull, .clockwise = instance.mirrored, .blend = gl::Blend::through});
        const std::uintptr_t offset = range.first_index * sizeof(std::uint32_t);
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(range.index_count),
                                                      GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset), 1,
                                                      range.base_vertex, index);
    };
    // The far side of a two-sided body is seen through its near side.
    if (material.double_sided) draw_faces(GL_FRONT);
    draw_faces(GL_BACK);
}

}  // namespace tyndall
