#pragma once

#include <map>
#include <memory>

#include "engine/render/frame_module.h"
#include "engine/scene/medium.h"
#include "volumetrics/volumetrics.h"

namespace tyndall {

/// In the module's terms. Throws Error for a medium that fills space.
[[nodiscard]] volumetrics::LocalMedium local_medium(const Medium& bounded);

/// The scene's density grids as the module has them, one for one.
class ModuleGrids {
  public:
    [[nodiscard]] const std::shared_ptr<const volumetrics::DensityGrid>& of(
        const std::shared_ptr<const DensityGrid>& grid);
    void keep_those_of(const std::vector<Medium>& media);

  private:
    std::map<std::shared_ptr<const DensityGrid>, std::shared_ptr<const volumetrics::DensityGrid>> grids_;
};

/// The volumetrics module in a renderer's slot: translates the frame into the module's terms and its results back.
/// A GL context must be current on destruction if there was a frame.
class VolumetricsAdapter : public FrameModule {
  public:
    volumetrics::Settings settings;  ///< of the next frame
    bool show_acceptance = false;    ///< the display shows the layer acceptance, while there is a temporal filter

    [[nodiscard]] bool wants_motion(const FrameContext& frame) const override;
    void add_before_lighting(FrameContext& frame, const GBuffer& gbuffer, std::span<const Aabb> transparents,
                             LightSources& lights) override;
    [[nodiscard]] TextureRef add_after_lighting(FrameContext& frame, TextureRef color) override;
    [[nodiscard]] Transparents transparents() const override;
    [[nodiscard]] TextureRef add_display(FrameContext& frame, TextureRef display) override;
    /// scattering in cd/m² and transmittance 0..1 (0 and 1 without a medium); acceptance, the share of earlier
    /// frames in each pixel's light (volumetrics::Outputs), from red (none) to green (all of it), black without a
    /// temporal filter; samples, of technique epipolar with samples (volumetrics::Outputs).
    [[nodiscard]] std::vector<Layer> layers() const override;
    void forget_history() override;

    /// What the module keeps between frames.
    [[nodiscard]] std::size_t persistent_bytes() const;

  private:
    std::unique_ptr<volumetrics::Volumetrics> module_;  ///< from the first frame on
    ModuleGrids grids_;
    volumetrics::Inputs inputs_;    ///< of this frame
    volumetrics::Outputs outputs_;  ///< and what came of them
};

}  // namespace tyndall
