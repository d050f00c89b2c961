#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "engine/gl/program.h"
#include "engine/graph/history.h"
#include "reconstruction/changed_lamps.h"
#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// What the setting `temporal` keeps from frame to frame: its textures as they were shown, and beside them the
/// depth of the surface that each pixel saw, see shaders/volumetrics/reconstruction/temporal.frag.
class TemporalHistory {
  public:
    static constexpr std::size_t most_textures = 4;

    /// Before the pass is added, at a size, of textures of these descriptions. Another mode, place, technique,
    /// resolution, size or number of textures ends the history.
    void begin_frame(const Inputs& inputs, const Settings& settings, glm::ivec2 size,
                     const std::vector<gl::TextureDesc>& textures);
    /// A frame without a history: frees it.
    void release() { *this = TemporalHistory(); }

    [[nodiscard]] bool valid() const { return surface_.valid(); }
    [[nodiscard]] History& texture(std::size_t i) { return textures_[i]; }
    [[nodiscard]] History& surface() { return surface_; }
    [[nodiscard]] std::size_t bytes() const;

    /// Camera and surfaces are where they were.
    [[nodiscard]] bool still() const;
    /// Sets the uniforms of temporal.frag that tell where the camera was and what is known to have changed since
    /// the frame before: the sun turned, or came or went; the camera travels; global media are others; lamps moved,
    /// came or went.
    void set_changes(const gl::Program& shader) const;
    [[nodiscard]] glm::mat4 clip_before_from_view() const;
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
    using Key = std::tuple<Temporal, TemporalPlace, std::string, Resolution, std::size_t>;
    std::array<History, most_textures> textures_;
    History surface_;
    State previous_, current_;
    Key key_{};
    unsigned frame_ = 0;
};

}  // namespace tyndall::volumetrics
