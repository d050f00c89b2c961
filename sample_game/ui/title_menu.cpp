#include "sample_game/ui/title_menu.h"

#include <imgui.h>

#include "sample_game/ui/banner.h"

namespace tyndall {

MenuRequests TitleMenu::frame(const std::string& words, PlayerSettings& settings, PlayerRows& rows,
                              const Input& input) {
    MenuRequests requests;
    if (!settings_) {
        title_banner(words);
        begin_menu("##title", false);
        requests = choices(rows);
    } else {
        // Before the rows, which may wait for the key themselves.
        const bool leave = !rows.waits_for_key() && (input.pressed(Key::escape) || input.gamepad.lantern);
        rows.frame(settings, input, begin_menu("Settings"));
        ImGui::Separator();
        requests.go_on = menu_button("Back  (Esc)") || leave;
        settings_ = !requests.go_on;
    }
    ImGui::End();
    return requests;
}

MenuRequests TitleMenu::choices(PlayerRows& rows) {
    MenuRequests requests;
    rows.close();
    requests.walk = menu_button("Walk");
    ImGui::SetItemDefaultFocus();
    requests.explore = menu_button("Explore");
    settings_ = menu_button("Settings");
    requests.quit = menu_button("Quit");
    return requests;
}

}  // namespace tyndall
