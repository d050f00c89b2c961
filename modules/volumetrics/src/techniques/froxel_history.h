#pragma once

#include "engine/graph/history.h"
#include "media/media.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// What the technique froxel keeps from frame to frame: the share of sun and lamps that is visible in each froxel,
/// and over how many frames it is a mean. Nothing is kept of the light itself, so none of it lags.
class FroxelHistory : public Kept {
  public:
    /// Once a frame, before the passes are added. Another number of froxels ends the history.
    void begin_frame(const Inputs& inputs, const Settings& settings, const FrameMedia& media);

    [[nodiscard]] bool valid() const { return visibility_.valid() && certainty_.valid(); }
    [[nodiscard]] History& visibility() { return visibility_; }
    [[nodiscard]] History& certainty() { return certainty_; }
    [[nodiscard]] std::size_t bytes() const override;

    /// Where in its froxels this frame samples visibility: 0..1 of the column's width and height (0.5 is the ray),
    /// and the phase of the sequence along the ray, below 0 for the middle. A first frame has no other to be
    /// averaged with, so it samples the middle.
    [[nodiscard]] glm::vec3 jitter() const;
    /// The froxels are where they were.
    [[nodiscard]] bool still() const { return previous_ == current_; }
    /// Sets the uniforms of froxel_history.comp that tell where the froxels were.
    void set_uniforms(const gl::Program& shader) const;
    /// Frames that the sun's visibility may be averaged over, as the sun turned since the frame before.
    [[nodiscard]] float sun_frames() const;

  private:
    struct View {
        glm::mat4 view{1}, projection{1};
        int distribution = 0;  ///< FROXEL_*
        glm::vec2 depths{0};   ///< nearest, farthest
        glm::mat4 begins{0}, lengths{0};
        friend bool operator==(const View&, const View&) = default;
    };
    History visibility_, certainty_;
    View previous_, current_;
    glm::vec3 previous_sun_{0}, current_sun_{0};
    glm::uvec4 few_lamps_[MAX_FEW_LAMPS / 4] = {};
    unsigned frame_ = 0;  ///< since the history began
};

}  // namespace tyndall::volumetrics
