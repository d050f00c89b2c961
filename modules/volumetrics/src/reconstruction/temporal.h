#pragma once

#include <tuple>
#include <vector>

#include "engine/graph/history.h"
#include "frame/passes.h"
#include "reconstruction/changed_lamps.h"

namespace tyndall::volumetrics {

/// What the setting `temporal` keeps from frame to frame: scattering and transmittance as they were shown, and
/// beside them the depth of the surface that each pixel saw, see shaders/volumetrics/reconstruction/temporal.frag.
class TemporalHistory {
  public:
    /// Before the pass is added. `scattering` and `transmittance` (size 0: none) are those of the new frame.
    /// Another mode, place, technique, resolution or size ends the history.
    void begin_frame(const Inputs& at, const Settings& settings, const gl::TextureDesc& scattering,
                     const gl::TextureDesc& transmittance);
    /// The frame was drawn.
    void end_frame();
    /// A frame without a history: frees it.
    void release() { *this = TemporalHistory(); }

    [[nodiscard]] bool valid() const;
    [[nodiscard]] const History& scattering() const { return scattering_; }
    [[nodiscard]] const History& transmittance() const { return transmittance_; }  ///< empty where one value holds
    [[nodiscard]] const History& surface() const { return surface_; }
    [[nodiscard]] std::size_t bytes() const;

    /// Camera and surfaces are where they were.
    [[nodiscard]] bool still() const;
    [[nodiscard]] glm::mat4 clip_before_from_view() const;
    /// Sets the uniforms of temporal.frag that tell what is known to have changed since the frame before: the sun
    /// turned, or came or went; the camera travels; global media are others; lamps moved, came or went.
    void set_changes(const gl::Program& shader) const;
    [[nodiscard]] unsigned frame() const { return frame_; }  ///< since the history began

  private:
    struct State {
        glm::mat4 view{1}, projection{1};
        glm::vec3 eye{0};
        bool motion = false, has_sun = false;
        glm::vec3 sun_direction{0};
        std::vector<GlobalMedium> global;
        std::vector<Lamp> lamps;
    };
    [[nodiscard]] float known_frames() const;
    using Key = std::tuple<Temporal, TemporalPlace, Technique, Resolution>;
    History scattering_, transmittance_, surface_;
    bool chromatic_ = false;
    State previous_, current_;
    Key key_{};
    unsigned frame_ = 0;
};

}  // namespace tyndall::volumetrics
