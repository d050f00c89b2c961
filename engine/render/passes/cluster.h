#pragma once

#include "engine/gl/buffer.h"
#include "engine/render/frame_context.h"
#include "engine/render/light_set.h"

namespace tyndall {

/// Clustered light culling: a list of the lamps that reach each cluster of the view frustum, in screen tiles and
/// logarithmic slices of view depth (Olsson, Billeter, Assarsson 2012, "Clustered Deferred and Forward Shading").
class ClusterPass {
  public:
    struct Output {
        BufferRef ranges, lights;
    };
    /// Adds light_cull and cluster and fills FrameData::cluster_size and depth. `pyramid` (add_depth_pyramid) may
    /// be empty: no occlusion test. Throws Error when the lists could outgrow what a buffer may hold.
    Output add(FrameContext& frame, const LightSet& lights, TextureRef pyramid);
    void bind() const;  ///< at BINDING_CLUSTERS and BINDING_CLUSTER_LIGHTS

    // For tests and statistics, after execute.
    [[nodiscard]] const gl::Buffer& ranges() const { return ranges_; }
    [[nodiscard]] const gl::Buffer& pool() const { return pool_; }
    [[nodiscard]] const gl::Buffer& visible() const { return visible_; }

  private:
    void reserve(const FrameContext& frame, const LightSet& lights);
    gl::Buffer visible_, rows_, ranges_, pool_;
    bool warned_ = false;
};

/// FrameData's part about clusters; also needed where no lamp is in view.
void set_cluster_grid(shared::FrameData& frame, const RenderSettings& settings, float znear, std::size_t lights);

/// Entries that the lists of all clusters can have at most: each lamp in every cluster of the box around its reach.
[[nodiscard]] std::size_t cluster_list_bound(const shared::FrameData& frame,
                                             std::span<const shared::GpuLight> lights);

}  // namespace tyndall
