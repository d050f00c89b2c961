#include "sample_game/ui/player_rows.h"

#include <fmt/format.h>
#include <imgui.h>

#include "sample_game/ui/settings_panel.h"

namespace tyndall {

void PlayerRows::frame(PlayerSettings& settings, const Input& input, float width) {
    ImGui::PushItemWidth(width * 0.5f);
    settings_rows({&player_settings_table(), &settings});
    ImGui::PopItemWidth();
    if (ImGui::CollapsingHeader("Keys"))
        keys(settings.keys, input);
    else
        close();
}

void PlayerRows::close() {
    waiting_ = nullptr;
    problem_.clear();
}

void PlayerRows::keys(KeyBindings& keys, const Input& input) {
    if (waiting_ != nullptr) take(keys, input);
    for (const Setting& row : key_bindings_table().settings()) {
        const std::string key = &row == waiting_ ? "press a key, Esc keeps it"
                                                 : key_label(static_cast<Key>(static_cast<int>(row.get(&keys))));
        if (ImGui::Button(fmt::format("{}##{}", key, row.key).c_str(), ImVec2(ImGui::CalcItemWidth(), 0))) {
            waiting_ = &row;
            problem_.clear();
        }
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::TextUnformatted(row.label.c_str());
    }
    if (!problem_.empty()) ImGui::TextWrapped("%s", problem_.c_str());
    if (ImGui::Button("Default keys", ImVec2(-1, 0))) {
        keys = {};
        close();
    }
}

void PlayerRows::take(KeyBindings& keys, const Input& input) {
    if (input.pressed(Key::escape) || input.gamepad.lantern) return close();
    for (int i = 0; i < static_cast<int>(Key::count); ++i) {
        if (!input.pressed(static_cast<Key>(i))) continue;
        problem_ = rebind(keys, *waiting_, static_cast<Key>(i));
        if (problem_.empty()) waiting_ = nullptr;
        return;
    }
}

}  // namespace tyndall
