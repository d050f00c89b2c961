#include "sample_game/ui/debug_ui.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "sample_game/play_choice.h"
#include "sample_game/ui/passes_panel.h"
#include "sample_game/ui/settings_panel.h"

namespace tyndall {
namespace {

const ImVec4 red{1.0f, 0.35f, 0.3f, 1.0f};
constexpr float overlay_margin = 10;                          // px
const ImVec2 window_position{12, 12}, window_size{430, 650};  // px; less where the screen is smaller
constexpr ImGuiWindowFlags overlay_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                           ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;

/// Where overlay lines wrap, so that they stay inside a window `width` pixels wide.
void wrap_at(float width) {
    ImGui::PushTextWrapPos(std::max(width - 2 * (overlay_margin + ImGui::GetStyle().WindowPadding.x), 100.0f));
}

void style() {
    ImGui::StyleColorsDark();
    ImGuiStyle& s = ImGui::GetStyle();
    s.WindowRounding = 6;
    s.FrameRounding = 4;
    s.Colors[ImGuiCol_WindowBg] = ImVec4(0.06f, 0.06f, 0.07f, 0.95f);
    s.Colors[ImGuiCol_TitleBgActive] = ImVec4(0.35f, 0.22f, 0.09f, 1);
    s.Colors[ImGuiCol_Header] = ImVec4(0.42f, 0.28f, 0.12f, 0.6f);
    s.Colors[ImGuiCol_HeaderHovered] = ImVec4(0.55f, 0.36f, 0.15f, 0.8f);
    s.Colors[ImGuiCol_SliderGrab] = s.Colors[ImGuiCol_CheckMark] = ImVec4(0.95f, 0.65f, 0.25f, 1);
    s.Colors[ImGuiCol_Button] = s.Colors[ImGuiCol_Tab] = ImVec4(0.32f, 0.22f, 0.11f, 0.9f);
    s.Colors[ImGuiCol_ButtonHovered] = s.Colors[ImGuiCol_TabHovered] = ImVec4(0.6f, 0.4f, 0.17f, 1);
    s.Colors[ImGuiCol_ButtonActive] = s.Colors[ImGuiCol_TabActive] = ImVec4(0.7f, 0.46f, 0.19f, 1);
    s.Colors[ImGuiCol_HeaderActive] = ImVec4(0.7f, 0.46f, 0.19f, 1);
    s.Colors[ImGuiCol_FrameBgHovered] = s.Colors[ImGuiCol_FrameBgActive] = ImVec4(0.35f, 0.29f, 0.22f, 0.8f);
    s.Colors[ImGuiCol_SliderGrabActive] = ImVec4(1, 0.8f, 0.45f, 1);
    s.Colors[ImGuiCol_NavHighlight] = amber();
    s.Colors[ImGuiCol_FrameBg] = ImVec4(0.2f, 0.19f, 0.18f, 0.7f);
}

template <class Item>
void choose(const char* label, const std::vector<Item>& items, std::size_t current,
            const std::function<void(std::size_t)>& chosen) {
    if (!ImGui::BeginCombo(label, items[current].name.c_str())) return;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (ImGui::Selectable(items[i].name.c_str(), i == current)) chosen(i);
    ImGui::EndCombo();
}

}  // namespace

void DebugUi::ContextDeleter::operator()(ImGuiContext* context) const {
    ImGui::DestroyContext(context);
}

DebugUi::DebugUi(ShaderLibrary& shaders) : context_(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_HasGamepad;
    style();
    renderer_ = std::make_unique<ImguiRenderer>(shaders);
    viewer_ = std::make_unique<TextureViewer>(shaders);
}

DebugUi::~DebugUi() = default;

bool DebugUi::wants_keyboard() const {
    return (visible && ImGui::GetIO().WantTextInput) || rows_.waits_for_key();
}
bool DebugUi::wants_pointer() const {
    return visible && ImGui::GetIO().WantCaptureMouse;
}

void DebugUi::hud_figures(const Session& session, const Hud& hud) {
    const bool timed = !session.renderer->timings().empty();
    const std::string volumetrics =
        timed ? fmt::format("{:.2f} ms volumetrics", pass_milliseconds(*session.renderer, "volumetrics/"))
              : std::string("volumetrics not timed");
    const bool scaled = session.size.x < static_cast<int>(ImGui::GetIO().DisplaySize.x);
    const std::string size = scaled ? fmt::format("{} x {}  |  ", session.size.x, session.size.y) : "";
    ImGui::Text("%s  |  %s%.1f ms frame  |  %s  |  %s", session.settings.get("technique").c_str(), size.c_str(),
                hud.frame_ms, volumetrics.c_str(), hud.place.c_str());
}

void DebugUi::hud_line(const Session& session, const Hud& hud) const {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(overlay_margin, screen.y - overlay_margin), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowBgAlpha(0.45f);
    if (ImGui::Begin("hud", nullptr, overlay_flags)) {
        wrap_at(screen.x);
        if (!hud.message.empty()) ImGui::TextUnformatted(hud.message.c_str());
        if (hud_visible) hud_figures(session, hud);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void DebugUi::shader_errors(const ShaderLibrary& shaders) const {
    if (shaders.errors().empty()) return;
    const float width = ImGui::GetIO().DisplaySize.x;
    ImGui::SetNextWindowPos(ImVec2(width - overlay_margin, overlay_margin), ImGuiCond_Always, ImVec2(1, 0));
    ImGui::SetNextWindowBgAlpha(0.8f);
    if (ImGui::Begin("shader errors", nullptr, overlay_flags)) {
        wrap_at(width);
        for (const std::string& error : shaders.errors()) ImGui::TextColored(red, "%s", error.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void DebugUi::level(Session& session, LevelLogic& logic, float& scale) {
    if (!ImGui::CollapsingHeader("Level", ImGuiTreeNodeFlags_DefaultOpen)) return;
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
    if (has_level) {
        choose("Time of day (T)", logic.day_times(), logic.day_time(),
               [&](std::size_t i) { logic.set_day_time(session.scene, i); });
        choose("Fog (G)", logic.fogs(), logic.fog(), [&](std::size_t i) { logic.set_fog(session.scene, i); });
    }
    ImGui::SliderFloat("Scale of the picture", &scale, static_cast<float>(least_scale), 1, "%.2f",
                       ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopItemWidth();
}

void DebugUi::presets(Session& session) {
    if (!ImGui::CollapsingHeader("Presets")) return;
    const auto attempt = [&](const std::string& done, const std::function<void()>& action) {
        try {
            action();
            preset_message_ = done;
        } catch (const Error& e) {
            preset_message_ = e.what();
        }
    };
    for (const std::string& name : preset_names()) {
        if (ImGui::Button(name.c_str())) attempt(name + " applied", [&] { apply_preset(session.settings, name); });
        ImGui::SameLine();
    }
    if (ImGui::Button("defaults")) attempt("defaults applied", [&] { session.settings.reset_to_defaults(); });
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
    ImGui::InputText("##file", &preset_path_);
    ImGui::SameLine();
    if (ImGui::Button("load"))
        attempt(preset_path_ + " applied", [&] { apply_preset(session.settings, preset_path_); });
    ImGui::SameLine();
    if (ImGui::Button("save"))
        attempt(preset_path_ + " saved",
                [&] { write_text(preset_path_, session.settings.to_json().dump(2) + "\n"); });
    if (!preset_message_.empty()) ImGui::TextWrapped("%s", preset_message_.c_str());
}

DebugUi::Requests DebugUi::window(Session& session, LevelLogic& logic, float& scale) {
    Requests requests;
    const auto tab = [](const char* name, const std::function<void()>& content) {
        if (!ImGui::BeginTabItem(name)) return;
        if (ImGui::BeginChild(name)) content();  // scrolls below the tabs
        ImGui::EndChild();
        ImGui::EndTabItem();
    };
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 largest(std::max(screen.x - 2 * window_position.x, 100.0f),
                         std::max(screen.y - 2 * window_position.y, 100.0f));
    ImGui::SetNextWindowPos(window_position, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(window_size, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(100, 100), largest);
    if (ImGui::Begin("Tyndall  (F1)", &visible) && ImGui::BeginTabBar("tabs")) {
        tab("Settings", [&] {
            level(session, logic, scale);
            presets(session);
            settings_panel(session.settings, session.volumetrics.show_acceptance);
        });
        tab("Passes", [&] { passes_panel(session); });
        tab("Textures", [&] { viewer_->panel(session.renderer->passes()); });
        requests.screenshot = ImGui::TabItemButton("Picture (F2)", ImGuiTabItemFlags_Trailing);
        ImGui::EndTabBar();
    }
    ImGui::End();
    return requests;
}

DebugUi::Requests DebugUi::frame(Session& session, LevelLogic& logic, const Hud& hud, const Screen& screen,
                                 float& scale, double dt, bool pointer_is_free, PlayerSettings& player) {
    const Input& input = session.context->input();
    input_.feed(input, screen.size(), dt, pointer_is_free);
    // Only in menus: elsewhere the same keys and buttons walk.
    const bool menu = paused || title;
    ImGui::GetIO().ConfigFlags = menu && !rows_.waits_for_key()
                                     ? ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavEnableGamepad
                                     : ImGuiConfigFlags_None;
    ImGui::NewFrame();
    Requests requests;
    if (hud_visible || (hud.message_alone && !hud.message.empty())) hud_line(session, hud);
    if (hud.walk && !paused) walk_banner(*hud.walk);
    shader_errors(*session.shaders);
    if (visible) requests = window(session, logic, scale);
    if (title)
        requests.menu = title_menu_.frame(*title, player, rows_, input);
    else if (paused)
        requests.menu = pause_menu(player, rows_, input, places, has_title);
    else
        rows_.close();
    ImGui::Render();
    renderer_->draw(screen.framebuffer(), screen.size());
    return requests;
}

}  // namespace tyndall
