#include "sample_game/ui/pause_menu.h"

#include <imgui.h>

#include <algorithm>

#include "sample_game/ui/settings_panel.h"

namespace tyndall {

PauseMenuRequests pause_menu(PlayerSettings& settings, const std::vector<std::string>& places) {
    PauseMenuRequests requests;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(screen.x - 24, 360.0f);
    ImGui::SetNextWindowPos(ImVec2(screen.x / 2, screen.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, std::max(screen.y - 24, 100.0f)));
    ImGui::SetNextWindowFocus();
    if (ImGui::Begin("Tyndall", nullptr,
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_AlwaysAutoResize)) {
        const auto button = [](const char* text) { return ImGui::Button(text, ImVec2(-1, 0)); };
        requests.go_on = button("Go on  (Esc)");
        ImGui::SetItemDefaultFocus();
        ImGui::Separator();
        ImGui::PushItemWidth(width * 0.5f);
        settings_rows({&player_settings_table(), &settings});
        ImGui::PopItemWidth();
        ImGui::Separator();
        const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (i % 3 != 0) ImGui::SameLine();
            if (ImGui::Button(places[i].c_str(), ImVec2(third, 0))) requests.place = places[i];
        }
        if (!places.empty()) ImGui::Separator();
        requests.debug_ui = button("All settings, passes, textures  (F1)");
        requests.quit = button("Quit  (Q)");
    }
    ImGui::End();
    return requests;
}

}  // namespace tyndall
