#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace tyndall {

constexpr double least_scale = 0.1;  ///< greatest: 1

/// What `tyndall play` was told.
struct PlayGiven {
    std::optional<glm::ivec2> window;
    std::optional<float> scale;
    std::optional<double> frame_budget;  ///< ms
    std::optional<std::string> preset;
};

/// What it does.
struct PlayChoice {
    glm::ivec2 window;    ///< px
    float scale;          ///< of the sides of the picture of the scene to those of the window, at first
    double frame_budget;  ///< ms a frame that the scale is to keep to; 0: it stays as it is
    std::optional<std::string> preset;  ///< applied before `--technique` and `--set`
    std::string told;                   ///< one line for the player; empty: nothing was chosen for a slow driver
};

/// `renderer`: GL_RENDERER. A software rasteriser gets a picture as large as it can walk through, where nothing
/// else is asked for.
[[nodiscard]] PlayChoice choose_play(std::string_view renderer, const PlayGiven& given);

/// Pixels of the picture of the scene.
[[nodiscard]] glm::ivec2 scaled_size(glm::ivec2 window, float scale);

}  // namespace tyndall
