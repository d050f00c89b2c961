#pragma once

#include <vector>

#include "engine/gl/buffer.h"
#include "engine/gl/vertex_array.h"
#include "engine/render/frame_context.h"
#include "engine/render/frame_module.h"
#include "engine/render/passes/gbuffer.h"
#include "engine/render/passes/lighting.h"
#include "shaders/shared/particles.h"

namespace tyndall {

/// Transparent surfaces and particles, over the finished picture of the opaque ones: lit and shadowed as those
/// are, but without the colour of glass before the light; modules may change what each adds to the picture, such as
/// fog it at its own depth. They are drawn back to front by the view depth of their middle, an instance as a whole:
/// surfaces that cut each other, or a small one before the near part of a large one, may blend in the wrong order.
class TransparentPass {
  public:
    /// Finds what of the scene is in view at frame.time. To be called before `add`.
    void gather(const FrameContext& frame);
    [[nodiscard]] std::span<const Aabb> bounds() const { return bounds_; }  ///< round each thing in view
    /// Adds the pass "transparent", or skips it. Returns the new version of `color` (RGBA16F).
    [[nodiscard]] TextureRef add(FrameContext& frame, const GBuffer& gbuffer, const LightSources& sources,
                                 std::span<FrameModule* const> modules, TextureRef color);
    [[nodiscard]] std::size_t instance_count() const { return instances_.size(); }
    [[nodiscard]] std::size_t particle_count() const { return particles_.size(); }

  private:
    /// Consecutive entries of instances_ (one) or of particles_ that nothing comes between.
    struct Draw {
        bool particles;
        std::uint32_t first, count;
    };
    void draw_instance(const FrameContext& frame, const gl::Program& shader, std::uint32_t index) const;

    std::vector<Draw> draws_;  ///< back to front
    std::vector<Aabb> bounds_;
    std::vector<GpuScene::DrawnInstance> instances_;
    std::vector<shared::Particle> particles_;
    gl::Buffer drawn_, particle_buffer_;
    gl::VertexArray no_vertices_;
};

}  // namespace tyndall
