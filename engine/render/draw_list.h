#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/gl/buffer.h"
#include "engine/render/gpu_scene.h"

namespace tyndall {

/// Indirect draws of the instances that meet a frustum: one multi-draw per material and winding,
/// equal meshes instanced.
/// Shaders read the instance from vertex attributes, see GpuScene::bind.
class DrawList {
  public:
    /// Materials with alpha_blend are left out but for glass: those of them that cast shadows.
    enum class Filter { all, static_shadow_casters, moving_shadow_casters, glass, static_glass };
    /// Culls on the CPU (conservative boxes) and uploads commands.
    void build(const GpuScene& scene, const Frustum& frustum, Filter filter);
    /// Several views at once (shadow tiles): view i's commands are drawn by draw(i, …).
    void build(const GpuScene& scene, std::span<const Frustum> frusta, Filter filter);

    /// What a multi-draw has in common.
    struct Surfaces {
        int material;
        bool mirrored;  ///< Instance::mirrored
        bool operator==(const Surfaces&) const = default;
    };
    /// Calls `bind` before each multi-draw; false leaves it out.
    void draw(const GpuScene& scene, const std::function<bool(Surfaces)>& bind, int view = 0) const;
    [[nodiscard]] std::size_t instance_count(int view = 0) const;
    [[nodiscard]] std::size_t triangle_count(int view = 0) const;
    [[nodiscard]] std::size_t draw_call_count(int view = 0) const;

  private:
    struct Batch {
        Surfaces surfaces;
        std::uint32_t first_command, command_count;
    };
    struct ViewBatches {
        std::vector<Batch> batches;
        std::size_t instances = 0, triangles = 0;
    };
    std::vector<ViewBatches> views_;
    gl::Buffer commands_, drawn_;
};

}  // namespace tyndall
