#pragma once

#include <optional>
#include <string>

namespace tyndall {

/// What a player chose in a menu: the title or the pause.
struct MenuRequests {
    bool go_on = false, quit = false, debug_ui = false, title = false, walk = false, explore = false;
    std::optional<std::string> place;
};

/// A window in the middle of the picture, for pointer, keyboard and gamepad. Within a Dear ImGui frame; what is in
/// it follows, then ImGui::End. Its width, px.
float begin_menu(const char* title, bool title_bar = true);
/// A button as wide as the menu.
bool menu_button(const char* text);

}  // namespace tyndall
