#include "sample_game/ui/imgui_input.h"

#include <imgui.h>

#include <algorithm>
#include <limits>

namespace tyndall {

ImguiInput::ImguiInput() {
    ImGuiIO& io = ImGui::GetIO();
    const auto map = [&](ImGuiKey_ imgui, Key key) { io.KeyMap[imgui] = static_cast<int>(key); };
    map(ImGuiKey_Tab, Key::tab);
    map(ImGuiKey_LeftArrow, Key::left);
    map(ImGuiKey_RightArrow, Key::right);
    map(ImGuiKey_UpArrow, Key::up);
    map(ImGuiKey_DownArrow, Key::down);
    map(ImGuiKey_PageUp, Key::page_up);
    map(ImGuiKey_PageDown, Key::page_down);
    map(ImGuiKey_Home, Key::home);
    map(ImGuiKey_End, Key::end);
    map(ImGuiKey_Delete, Key::del);
    map(ImGuiKey_Backspace, Key::backspace);
    map(ImGuiKey_Space, Key::space);
    map(ImGuiKey_Enter, Key::enter);
    map(ImGuiKey_Escape, Key::escape);
    map(ImGuiKey_A, Key::a);
    map(ImGuiKey_C, Key::c);
    map(ImGuiKey_V, Key::v);
    map(ImGuiKey_X, Key::x);
    map(ImGuiKey_Y, Key::y);
    map(ImGuiKey_Z, Key::z);
}

void ImguiInput::feed(const Input& input, glm::ivec2 size, double dt, bool pointer_is_free) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
    io.DeltaTime = std::max(static_cast<float>(dt), 1e-5f);
    constexpr float nowhere = -std::numeric_limits<float>::max();
    io.MousePos = pointer_is_free ? ImVec2(static_cast<float>(input.pointer.x), static_cast<float>(input.pointer.y))
                                  : ImVec2(nowhere, nowhere);
    // A key or button that went down and up within one slow frame counts for that frame. Some widgets notice a
    // press only when the pointer was there the frame before.
    const bool moved = input.pointer_delta != glm::dvec2(0);
    const Input::Modifiers modifiers = late_.any() && late_modifiers_ ? *late_modifiers_ : input.modifiers();
    for (std::size_t i = 0; i < late_.size(); ++i) {
        const bool pressed = input.buttons_pressed[i];
        io.MouseDown[i] = pointer_is_free && (late_[i] || input.buttons_down[i] || pressed) && !(pressed && moved);
        late_[i] = pressed && moved;
    }
    late_modifiers_ = input.press_modifiers;
    io.MouseWheel = pointer_is_free ? static_cast<float>(input.scroll) : 0.0f;
    for (int key = 0; key < static_cast<int>(Key::count); ++key)
        io.KeysDown[key] = input.keys_down[key] || input.keys_pressed[key];
    const auto& pad = input.gamepad.held;
    const auto navigate = [&](ImGuiNavInput_ to, bool held) { io.NavInputs[to] = held ? 1.0f : 0.0f; };
    navigate(ImGuiNavInput_DpadUp, pad.up);
    navigate(ImGuiNavInput_DpadDown, pad.down);
    navigate(ImGuiNavInput_DpadLeft, pad.left);
    navigate(ImGuiNavInput_DpadRight, pad.right);
    navigate(ImGuiNavInput_Activate, pad.accept || io.KeysDown[static_cast<int>(Key::enter)]);
    navigate(ImGuiNavInput_Cancel, pad.back);
    io.KeyShift = modifiers.shift;
    io.KeyCtrl = modifiers.control;
    io.KeyAlt = modifiers.alt;
    io.AddInputCharactersUTF8(input.text.c_str());
}

}  // namespace tyndall
