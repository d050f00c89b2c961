#include "sample_game/ui/pause_menu.h"

#include <imgui.h>

namespace tyndall {

MenuRequests pause_menu(PlayerSettings& settings, PlayerRows& rows, const Input& input,
                        const std::vector<std::string>& places, bool to_title) {
    MenuRequests requests;
    const float width = begin_menu("Tyndall");
    requests.go_on = menu_button("Go on  (Esc)");
    ImGui::SetItemDefaultFocus();
    ImGui::Separator();
    rows.frame(settings, input, width);
    ImGui::Separator();
    const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i % 3 != 0) ImGui::SameLine();
        if (ImGui::Button(places[i].c_str(), ImVec2(third, 0))) requests.place = places[i];
    }
    if (!places.empty()) ImGui::Separator();
    requests.debug_ui = menu_button("All settings, passes, textures  (F1)");
    if (to_title) requests.title = menu_button("Back to the title");
    requests.quit = menu_button("Quit  (Q)");
    ImGui::End();
    return requests;
}

}  // namespace tyndall
