#include "sample_game/ui/banner.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                   ImGuiWindowFlags_AlwaysAutoResize;

/// Whole steps: the letters are pictures.
float letter_scale() {
    return std::clamp(std::floor(ImGui::GetIO().DisplaySize.y / 340), 1.0f, 4.0f);
}

/// A window as wide as most of the screen, at a share of its height.
void begin(const char* name, float height, float background) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(screen.x - 20, 460 * letter_scale());
    ImGui::SetNextWindowPos(ImVec2(screen.x / 2, screen.y * height), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y));
    ImGui::SetNextWindowBgAlpha(background);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin(name, nullptr, flags);
    ImGui::PopStyleVar();
}

void lamps(const WalkBanner& banner) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float step = 14 * letter_scale(), radius = 3 * letter_scale();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (std::size_t i = 0; i < banner.count; ++i) {
        const float x = screen.x / 2 + step * (static_cast<float>(i) - static_cast<float>(banner.count - 1) / 2);
        const ImVec2 at(x, 2 * step);
        list.AddCircleFilled(at, radius + 2, IM_COL32(10, 8, 6, 140));
        if (i < banner.lit)
            list.AddCircleFilled(at, radius, ImGui::GetColorU32(amber()));
        else
            list.AddCircle(at, radius, ImGui::GetColorU32(pale()));
    }
}

}  // namespace

const ImVec4& amber() {
    static const ImVec4 color{0.95f, 0.65f, 0.25f, 1};
    return color;
}

const ImVec4& pale() {
    static const ImVec4 color{0.85f, 0.8f, 0.72f, 1};
    return color;
}

void centred(const std::string& text, const ImVec4& color) {
    const float scale = ImGui::GetFontSize() / ImGui::GetFont()->FontSize;
    const float width = ImGui::GetContentRegionAvail().x;
    const char* const end = text.data() + text.size();
    for (const char* line = text.data(); line < end;) {
        const char* line_end = ImGui::GetFont()->CalcWordWrapPositionA(scale, line, end, width);
        if (line_end == line) line_end = line + 1;  // a window of no width
        ImGui::SetCursorPosX((ImGui::GetWindowWidth() - ImGui::CalcTextSize(line, line_end).x) / 2);
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(line, line_end);
        ImGui::PopStyleColor();
        for (line = line_end; line < end && *line == ' ';) ++line;
    }
}

void title_banner(const std::string& words) {
    begin("name of the game", 0.17f, 0);
    ImGui::SetWindowFontScale(letter_scale() + 2);
    centred("Tyndall", amber());
    ImGui::SetWindowFontScale(letter_scale());
    centred(words, pale());
    ImGui::End();
}

void walk_banner(const WalkBanner& banner) {
    lamps(banner);
    if (banner.words.empty() && banner.prompt.empty()) return;
    begin("walk", 0.8f, 0.5f);
    ImGui::SetWindowFontScale(letter_scale());
    if (!banner.words.empty()) centred(banner.words, pale());
    if (!banner.prompt.empty()) centred(banner.prompt, amber());
    ImGui::End();
}

}  // namespace tyndall
