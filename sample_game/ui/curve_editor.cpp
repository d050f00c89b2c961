#include "sample_game/ui/curve_editor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int parts = int(volumetrics::froxel_curve_settings.size());
constexpr float lowest = 0.001f, highest = 1000;  // of the settings
constexpr float reach = 12;                       // px: how near to a point one has to press
const ImU32 background = IM_COL32(30, 28, 26, 255), line = IM_COL32(240, 170, 70, 255),
            ticks = IM_COL32(150, 150, 150, 160), chosen = IM_COL32(255, 225, 150, 255);

float& part(volumetrics::Settings& settings, int i) {
    return settings.froxels.*volumetrics::froxel_curve_settings[static_cast<std::size_t>(i)];
}

/// At 0..1 of the slices.
float share_at(const std::array<float, 17>& curve, float w) {
    const float position = std::clamp(w, 0.0f, 1.0f) * 16;
    const auto i = std::min(static_cast<std::size_t>(position), std::size_t{15});
    return curve[i] + (curve[i + 1] - curve[i]) * (position - static_cast<float>(i));
}

}  // namespace

float curve_axis(float depth_share) {
    return std::log1p(63 * depth_share) / std::log(64.0f);
}

float curve_depth(float height) {
    return std::expm1(height * std::log(64.0f)) / 63;
}

void move_curve_point(volumetrics::Settings& settings, int point, float depth_share) {
    float total = 0, before = 0;
    for (int i = 0; i < parts; ++i) {
        total += part(settings, i);
        if (i < point - 1) before += part(settings, i);
    }
    float &below = part(settings, point - 1), &above = part(settings, point);
    const float both = below + above;
    below = std::clamp(depth_share * total - before, lowest, both - lowest);
    above = std::clamp(both - below, lowest, highest);
    below = std::clamp(below, lowest, highest);
}

void curve_editor(volumetrics::Settings& settings) {
    const ImVec2 size(ImGui::CalcItemWidth(), curve_height), origin = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("froxel_curve", size);
    const auto place = [&](float w, float depth_share) {
        return ImVec2(origin.x + w * size.x, origin.y + (1 - curve_axis(depth_share)) * size.y);
    };
    const auto point_at = [&](int i, const std::array<float, 17>& curve) {
        return place(static_cast<float>(i) / parts, curve[static_cast<std::size_t>(2 * i)]);
    };

    std::array<float, 17> curve = volumetrics::froxel_curve(settings);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    int* held = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("held point"), 0);
    if (ImGui::IsItemActivated()) {
        *held = std::clamp(static_cast<int>(std::lround((mouse.x - origin.x) / size.x * parts)), 1, parts - 1);
        const ImVec2 point = point_at(*held, curve);
        if (std::hypot(mouse.x - point.x, mouse.y - point.y) > reach) *held = 0;
    }
    if (!ImGui::IsItemActive()) *held = 0;
    if (*held > 0 && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0)) {
        move_curve_point(settings, *held, curve_depth(1 - (mouse.y - origin.y) / size.y));
        curve = volumetrics::froxel_curve(settings);
    }
    if (ImGui::IsItemHovered()) {
        const float depth =
            settings.froxels.far * share_at(curve, std::clamp((mouse.x - origin.x) / size.x, 0.0f, 1.0f));
        ImGui::SetTooltip("Slices across, view depth upwards: %.3g m here. Drag the points.", double(depth));
    }

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(origin, ImVec2(origin.x + size.x, origin.y + size.y), background, 4);
    for (int slice = 0; slice <= settings.froxels.z; ++slice) {
        const float w = static_cast<float>(slice) / static_cast<float>(settings.froxels.z);
        const ImVec2 end = place(1, share_at(curve, w));
        draw.AddLine(ImVec2(end.x - 10, end.y), end, ticks);
    }
    for (int i = 0; i < 16; ++i)
        draw.AddLine(place(static_cast<float>(i) / 16, curve[static_cast<std::size_t>(i)]),
                     place(static_cast<float>(i + 1) / 16, curve[static_cast<std::size_t>(i + 1)]), line, 2);
    for (int i = 1; i < parts; ++i) draw.AddCircleFilled(point_at(i, curve), 4, i == *held ? chosen : line);
    ImGui::SameLine();
    ImGui::TextUnformatted("Froxel curve");
}

}  // namespace tyndall
