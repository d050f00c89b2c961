#pragma once

#include <string>

#include "sample_game/level_logic.h"
#include "sample_game/screen.h"
#include "sample_game/ui/banner.h"
#include "sample_game/ui/imgui_input.h"
#include "sample_game/ui/imgui_renderer.h"
#include "sample_game/ui/pause_menu.h"
#include "sample_game/ui/texture_viewer.h"
#include "sample_game/ui/title_menu.h"
#include "session/session.h"

struct ImGuiContext;

namespace tyndall {

/// The F1 window and the HUD line, with Dear ImGui. One per GL context.
class DebugUi {
  public:
    explicit DebugUi(ShaderLibrary& shaders);
    ~DebugUi();
    DebugUi(const DebugUi&) = delete;
    DebugUi& operator=(const DebugUi&) = delete;

    struct Hud {
        std::string place;
        double frame_ms = 0;
        std::string message;         ///< shown for a moment: "screenshot saved"
        bool message_alone = false;  ///< it is shown without the HUD line, too
        std::optional<WalkBanner> walk;
    };
    struct Requests {
        bool screenshot = false;
        MenuRequests menu;
    };
    /// Builds and draws over the screen. `scale`: of the scene, which the debug window changes. `pointer_is_free`:
    /// not captured for mouse look.
    Requests frame(Session& session, LevelLogic& logic, const Hud& hud, const Screen& screen, float& scale,
                   double dt, bool pointer_is_free, PlayerSettings& player);

    bool visible = false;              ///< the debug window (F1)
    bool hud_visible = true;           ///< the HUD line (H)
    bool paused = false;               ///< the menu (Esc)
    std::optional<std::string> title;  ///< the title screen, with these words
    bool has_title = false;            ///< the menu leads to it
    bool has_level = true;             ///< time of day and fog may be chosen
    std::vector<std::string> places;   ///< that the menu goes to
    /// A text field or a row of the player's keys takes what is typed.
    [[nodiscard]] bool wants_keyboard() const;
    [[nodiscard]] bool wants_pointer() const;

  private:
    void hud_line(const Session& session, const Hud& hud) const;
    static void hud_figures(const Session& session, const Hud& hud);
    void shader_errors(const ShaderLibrary& shaders) const;
    Requests window(Session& session, LevelLogic& logic, float& scale);
    void level(Session& session, LevelLogic& logic, float& scale);
    void presets(Session& session);

    struct ContextDeleter {
        void operator()(ImGuiContext* context) const;
    };
    std::unique_ptr<ImGuiContext, ContextDeleter> context_;
    ImguiInput input_;
    std::unique_ptr<ImguiRenderer> renderer_;
    std::unique_ptr<TextureViewer> viewer_;
    PlayerRows rows_;
    TitleMenu title_menu_;
    std::string preset_path_ = "tyndall-preset.json";
    std::string preset_message_;
};

}  // namespace tyndall
