#include "sample_game/ui/menu.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace tyndall {

float begin_menu(const char* title, bool title_bar) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(screen.x - 24, 360.0f);
    ImGui::SetNextWindowPos(ImVec2(screen.x / 2, screen.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, std::max(screen.y - 24, 100.0f)));
    ImGui::SetNextWindowFocus();
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_AlwaysAutoResize |
                     (title_bar ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoTitleBar));
    // What keys and gamepad would press is seen, and pressed, before they have moved.
    if (ImGui::IsWindowAppearing()) ImGui::GetCurrentContext()->NavDisableHighlight = false;
    return width;
}

bool menu_button(const char* text) {
    return ImGui::Button(text, ImVec2(-1, 0));
}

}  // namespace tyndall
