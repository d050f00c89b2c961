#include "engine/render/passes/shadow_casters.h"

#include <algorithm>
#include <bit>

namespace tyndall {
namespace {

const ProgramDesc depth_program{"shadow_depth",
                                {{GL_VERTEX_SHADER, "shaders/engine/shadow_depth.vert"},
                                 {GL_FRAGMENT_SHADER, "shaders/engine/shadow_depth.frag"}},
                                {{"ALPHA_MASK", {0, 1}}},
                                {}};
const ProgramRegistry::Registration depth_registration(depth_program);

void add_bounds(ShadowKey& key, const Aabb& box) {
    key.add(glm::vec4(box.min, 0));
    key.add(glm::vec4(box.max, 0));
}

}  // namespace

void ShadowKey::add(std::span<const float> values) {
    for (const float v : values) add(std::uint64_t{std::bit_cast<std::uint32_t>(v)});
}

Aabb static_bounds(std::span<const Instance> instances, const Aabb& all) {
    constexpr float backdrop = 300;  // m, the longest edge of what is not
    Aabb bounds;
    for (const Instance& instance : instances) {
        const glm::vec3 size = instance.bounds.max - instance.bounds.min;
        if (instance.dynamic || std::max({size.x, size.y, size.z}) > backdrop) continue;
        bounds.add(instance.bounds.min);
        bounds.add(instance.bounds.max);
    }
    return bounds.empty() ? all : bounds;
}

ShadowCasters::ShadowCasters(const Scene& scene, const GpuScene& gpu, bool glass)
    : scene_(scene), instances_(gpu.instances()) {
    ShadowKey key;
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const Instance& instance = instances_[i];
        if (!instance.cast_shadow || gpu.material(instance.material).alpha_blend != glass) continue;
        if (instance.dynamic) {
            moving_.push_back(i);
            continue;
        }
        key.add(std::uint64_t{gpu.range(instance.mesh).index_count});
        key.add(scene.nodes[instance.node].world);
        add_bounds(key, instance.bounds);
    }
    static_key_ = key.value();
}

std::uint64_t ShadowCasters::moving_key(const Frustum& volume) const {
    ShadowKey key;
    bool any = false;
    for (const std::size_t i : moving_) {
        if (!volume.intersects(instances_[i].bounds)) continue;
        any = true;
        key.add(std::uint64_t{i});
        key.add(scene_.nodes[instances_[i].node].world);
    }
    return any ? key.value() : 0;
}

bool ShadowCasters::moving_within(glm::vec3 center, float radius) const {
    for (const std::size_t i : moving_) {
        const Aabb& box = instances_[i].bounds;
        const glm::vec3 offset = center - glm::clamp(center, box.min, box.max);
        if (glm::dot(offset, offset) <= radius * radius) return true;
    }
    return false;
}

gl::DrawState ShadowDepth::state() {
    return {.depth_write = true};
}

void ShadowDepth::draw(const GpuScene& gpu, const DrawList& list, int view, const glm::mat4& world_to_clip,
                       bool depth_clamp) const {
    for (const bool fronts : {true, false}) {
        gl::apply({.depth_test = true,
                   .depth_write = true,
                   .cull = static_cast<GLenum>(fronts ? GL_BACK : GL_FRONT),
                   .depth_clamp = depth_clamp,
                   .slope_bias = fronts ? -0.5f : 0.0f,
                   .constant_bias = -2});
        draw_faces(gpu, list, view, world_to_clip, fronts);
    }
}

void ShadowDepth::draw_faces(const GpuScene& gpu, const DrawList& list, int view, const glm::mat4& world_to_clip,
                             bool fronts) const {
    const gl::Program* programs[2] = {};
    glBindSampler(0, 0);  // the scene's textures carry their own sampling
    list.draw(
        gpu,
        [&](DrawList::Surfaces surfaces) {
            const GpuScene::GpuMaterial& material = gpu.material(surfaces.material);
            if (material.double_sided && fronts) return false;
            if (!fronts) (material.double_sided ? glDisable : glEnable)(GL_CULL_FACE);
            glFrontFace(surfaces.mirrored ? GL_CW : GL_CCW);
            const gl::Program*& program = programs[material.alpha_mask];
            if (program == nullptr) {
                program = &shaders_.get(depth_program, {{"ALPHA_MASK", material.alpha_mask}});
                program->set("world_to_clip", world_to_clip);
            }
            program->use();
            if (!material.alpha_mask) return true;
            glBindTextureUnit(0, material.base_color);
            program->set("alpha_factor", material.base_color_factor.a);
            program->set("alpha_cutoff", material.emissive_alpha_cutoff.a);
            return true;
        },
        view);
}

}  // namespace tyndall
