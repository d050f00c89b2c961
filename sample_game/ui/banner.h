#pragma once

#include <string>

struct ImVec4;

namespace tyndall {

/// Words over the picture, in letters that suit its size, for a frame of Dear ImGui.

[[nodiscard]] const ImVec4& amber();
[[nodiscard]] const ImVec4& pale();
/// In the middle of a window, broken where it is too long.
void centred(const std::string& text, const ImVec4& color);

/// The name of the game and words below it, in the upper third.
void title_banner(const std::string& words);

/// What a walk says, and below it what can be done: in the lower third, either may be empty. Above, of `count`
/// lamps `lit` burn; 0: none are told.
struct WalkBanner {
    std::string words, prompt;
    std::size_t lit = 0, count = 0;
};
void walk_banner(const WalkBanner& banner);

}  // namespace tyndall
