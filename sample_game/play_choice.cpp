#include "sample_game/play_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/gl/software_driver.h"

namespace tyndall {
namespace {

constexpr glm::ivec2 usual_window{1280, 720}, software_window{960, 540};
constexpr float software_pixels = 384 * 216;  // of the scene
constexpr double software_budget = 100;       // ms a frame
constexpr const char* software_preset = "fast";

}  // namespace

PlayChoice choose_play(std::string_view renderer, const PlayGiven& given) {
    if (!gl::is_software_driver(renderer))
        return {given.window.value_or(usual_window), given.scale.value_or(1.0f), given.frame_budget.value_or(0),
                given.preset, ""};
    PlayChoice choice{given.window.value_or(software_window), 1, given.frame_budget.value_or(0), given.preset, ""};
    const float pixels = static_cast<float>(choice.window.x) * static_cast<float>(choice.window.y);
    choice.scale = given.scale.value_or(
        std::clamp(std::sqrt(software_pixels / pixels), static_cast<float>(least_scale), 1.0f));
    std::string chosen;
    if (!given.scale && !given.frame_budget) choice.frame_budget = software_budget;
    if (!given.scale && choice.scale < 1) {
        const glm::ivec2 scene = scaled_size(choice.window, choice.scale);
        chosen = fmt::format("the scene has {} x {} pixels", scene.x, scene.y);
        if (choice.frame_budget > 0)
            chosen += fmt::format(" at first, then as many as take {:.0f} ms a frame", choice.frame_budget);
    }
    if (!given.preset) {
        choice.preset = software_preset;
        chosen += fmt::format("{}preset {}", chosen.empty() ? "" : ", ", software_preset);
    }
    if (!chosen.empty())
        choice.told =
            fmt::format("No GPU ({}): {}. Change them in F1, or with --scale, --frame-budget and --preset.",
                        renderer.substr(0, renderer.find(' ')), chosen);
    return choice;
}

glm::ivec2 scaled_size(glm::ivec2 window, float scale) {
    return glm::max(glm::ivec2(glm::round(glm::vec2(window) * scale)), glm::ivec2(1));
}

}  // namespace tyndall
