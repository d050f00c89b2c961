#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/gl/state.h"
#include "engine/render/draw_list.h"
#include "engine/render/gpu_scene.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "engine/shader/shader_library.h"

namespace tyndall {

/// A 64-bit hash (FNV-1a over words) of what a shadow map was drawn from: an equal key needs no redraw.
class ShadowKey {
  public:
    void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ull; }
    void add(std::span<const float> values);
    void add(const glm::mat4& m) { add(std::span(&m[0][0], 16)); }
    void add(const glm::vec4& v) { add(std::span(&v[0], 4)); }
    [[nodiscard]] std::uint64_t value() const { return hash_ | 1; }  ///< never 0: 0 means never drawn

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

/// What a sun's map of the whole scene covers: everything that stands still, without the backdrop of hills and
/// plains, which would make its texels metres wide; where there is nothing else, those.
[[nodiscard]] Aabb static_bounds(std::span<const Instance> instances, const Aabb& all);

/// What casts shadows this frame, as keys: what is opaque, or glass.
class ShadowCasters {
  public:
    ShadowCasters(const Scene& scene, const GpuScene& gpu, bool glass = false);
    /// Of all casters that never move.
    [[nodiscard]] std::uint64_t static_key() const { return static_key_; }
    /// Of the moving casters that meet a volume, with their places; 0 where there are none.
    [[nodiscard]] std::uint64_t moving_key(const Frustum& volume) const;
    /// Whether a moving caster meets a sphere.
    [[nodiscard]] bool moving_within(glm::vec3 center, float radius) const;

  private:
    const Scene& scene_;
    std::span<const Instance> instances_;
    std::vector<std::size_t> moving_;
    std::uint64_t static_key_;
};

/// Draws depth of shadow casters into the bound framebuffer.
class ShadowDepth {
  public:
    explicit ShadowDepth(ShaderLibrary& shaders) : shaders_(shaders) {}
    /// For clearing the map.
    [[nodiscard]] static gl::DrawState state();
    /// Both sides of every triangle are drawn, so that open meshes cast too. The fronts are moved away from the
    /// light by half of what their depth changes over one texel: that keeps lit surfaces free of acne, and in
    /// closed bodies, however thin, the backs behind them keep their place. So do two-sided surfaces, which have no
    /// backs behind them.
    void draw(const GpuScene& gpu, const DrawList& list, int view, const glm::mat4& world_to_clip,
              bool depth_clamp) const;

  private:
    void draw_faces(const GpuScene& gpu, const DrawList& list, int view, const glm::mat4& world_to_clip,
                    bool fronts) const;
    ShaderLibrary& shaders_;
};

}  // namespace tyndall
