#include "sample_game/ui/settings_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "sample_game/ui/curve_editor.h"
#include "sample_game/ui/settings_sections.h"
#include "volumetrics/technique.h"

namespace tyndall {
namespace {

bool combo(const char* label, int& index, const std::vector<std::string>& names) {
    bool changed = false;
    if (ImGui::BeginCombo(label, names[index].c_str())) {
        for (int i = 0; i < static_cast<int>(names.size()); ++i)
            if (ImGui::Selectable(names[i].c_str(), i == index)) {
                index = i;
                changed = true;
            }
        ImGui::EndCombo();
    }
    return changed;
}

/// Draws the widget; true when `value` was changed.
bool edit(const Setting& s, double& value) {
    const std::string label = fmt::format("{}##{}", s.label, s.key);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (s.scale == SettingScale::logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    switch (s.type) {
        case SettingType::boolean: {
            bool b = value != 0;
            const bool changed = ImGui::Checkbox(label.c_str(), &b);
            value = b ? 1 : 0;
            return changed;
        }
        case SettingType::choice: {
            int i = static_cast<int>(value);
            const bool changed = combo(label.c_str(), i, s.choices);
            value = i;
            return changed;
        }
        case SettingType::integer: {
            if (!s.allowed.empty()) {
                std::vector<std::string> names;
                for (const double v : s.allowed) names.push_back(fmt::format("{}", v));
                const auto found = std::find(s.allowed.begin(), s.allowed.end(), value);
                int i = found == s.allowed.end() ? 0 : static_cast<int>(found - s.allowed.begin());
                const bool changed = combo(label.c_str(), i, names);
                value = s.allowed[i];
                return changed;
            }
            int i = static_cast<int>(value);
            const bool changed =
                ImGui::SliderInt(label.c_str(), &i, static_cast<int>(s.min), static_cast<int>(s.max), "%d", flags);
            value = i;
            return changed;
        }
        case SettingType::real: {
            float f = static_cast<float>(value);
            const bool changed = ImGui::SliderFloat(label.c_str(), &f, static_cast<float>(s.min),
                                                    static_cast<float>(s.max), "%.3g", flags);
            value = f;
            return changed;
        }
    }
    return false;
}

const char* effect_text(SettingEffect effect) {
    switch (effect) {
        case SettingEffect::uniform:
            return "a change costs nothing";
        case SettingEffect::resource:
            return "a change reallocates textures";
        case SettingEffect::permutation:
            return "a change selects another shader";
    }
    return "";
}

std::string value_text(const Setting& s, double value) {
    if (s.type == SettingType::choice) return s.choices[static_cast<std::size_t>(value)];
    if (s.type == SettingType::boolean) return value != 0 ? "on" : "off";
    return fmt::format("{:.6g}{}{}", value, s.unit.empty() ? "" : " ", s.unit);
}

void tooltip(const Setting& s) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(std::min(ImGui::GetFontSize() * 26, ImGui::GetIO().DisplaySize.x * 0.8f));
    ImGui::TextUnformatted(s.help.c_str());
    if (s.key == "technique")
        for (const std::string& name : s.choices)
            ImGui::BulletText("%s: %s", name.c_str(), volumetrics::technique(name).help.c_str());
    ImGui::TextDisabled("%s, default %s; %s. Right click: default.", s.key.c_str(),
                        value_text(s, s.default_value).c_str(), effect_text(s.effect));
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// The curve's settings are one drawing, shown while the curve is in use. True for these settings.
bool curve_row(const SettingsSet::Group& group, const Setting& s) {
    if (group.table != &volumetrics::settings_table() || !s.key.starts_with("froxel_curve_")) return false;
    auto& settings = *static_cast<volumetrics::Settings*>(group.object);
    if (s.key.ends_with("_1") && settings.froxels.distribution == volumetrics::DepthDistribution::curve)
        curve_editor(settings);
    return true;
}

void row(const Setting& s, void* object) {
    double value = s.get(object);
    if (edit(s, value)) s.set(object, value);
    if (ImGui::IsItemHovered() && !ImGui::GetIO().NavVisible) tooltip(s);  // by the pointer, not by keys
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) s.set(object, s.default_value);
}

/// The rows of one section, or of none (null).
void rows(const SettingsSet::Group& group, const SettingsSection* section) {
    const bool sections = group.table == &volumetrics::settings_table();
    for (const Setting& s : group.table->settings())
        if ((sections ? section_of(s.key) : nullptr) == section && !curve_row(group, s)) row(s, group.object);
}

std::string heading(const SettingsSet::Group& group, const SettingsSection& section) {
    for (const Setting& s : group.table->settings())
        if (s.key == section.summary)
            return fmt::format("{}: {}###{}", section.title, value_text(s, s.get(group.object)), section.title);
    return section.title;
}

void acceptance_row(bool& show, bool temporal) {
    ImGui::BeginDisabled(!temporal);
    ImGui::Checkbox("Show acceptance", &show);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Share of earlier frames in each pixel's light:\nred none, green all of it.");
}

void section_rows(const SettingsSet::Group& group, const SettingsSection& section, bool& show_acceptance) {
    const auto& settings = *static_cast<const volumetrics::Settings*>(group.object);
    if (!matters(section, settings.technique)) return;
    const bool own = section.own == settings.technique;
    ImGui::PushID(own ? "own" : "");  // a technique's own section is folded where it is another's, too
    const bool open =
        ImGui::TreeNodeEx(heading(group, section).c_str(),
                          ImGuiTreeNodeFlags_FramePadding | ImGuiTreeNodeFlags_SpanAvailWidth |
                              ImGuiTreeNodeFlags_NoAutoOpenOnLog | (own ? ImGuiTreeNodeFlags_DefaultOpen : 0));
    if (open) {
        rows(group, &section);
        if (section.summary == "temporal")
            acceptance_row(show_acceptance, settings.temporal.mode != volumetrics::Temporal::off);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

}  // namespace

void settings_rows(const SettingsSet::Group& group) {
    for (const Setting& s : group.table->settings()) row(s, group.object);
}

void settings_panel(SettingsSet& settings, bool& show_acceptance) {
    for (const SettingsSet::Group& group : settings.groups()) {
        if (!ImGui::CollapsingHeader(group.table->title().c_str(), ImGuiTreeNodeFlags_DefaultOpen)) continue;
        ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
        rows(group, nullptr);
        if (group.table == &volumetrics::settings_table())
            for (const SettingsSection& section : settings_sections())
                section_rows(group, section, show_acceptance);
        ImGui::PopItemWidth();
    }
}

}  // namespace tyndall
