#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/settings.h"
#include "engine/platform/gl_context.h"
#include "engine/render/renderer.h"
#include "engine/scene/scene.h"

namespace CLI {
class App;
}

namespace tyndall {

/// The options that every command which draws shares.
struct DrawOptions {
    std::string scene;
    std::string size;
    std::string context = "auto";
    std::optional<std::string> media, technique, preset;
    std::vector<std::string> set;

    /// Adds the options to a command; the scene is required unless it has a default.
    void add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size);
    [[nodiscard]] glm::ivec2 pixels() const;  ///< throws UsageError unless "WxH" within 1..16384
};

/// A scene with its settings, ready to be drawn: what `play`, `render` and `flythrough` have in common.
/// Construction order: settings (usage errors first), scene, context, renderer.
class Session {
  public:
    /// `window` asks for a visible one. Throws UsageError or Error.
    Session(const DrawOptions& options, bool window);

    SettingsSet settings;  ///< all of `options`' settings, by key
    FrameOptions options;
    Scene scene;
    glm::ivec2 size;
    std::unique_ptr<GlContext> context;
    std::unique_ptr<ShaderLibrary> shaders;
    std::unique_ptr<gl::GpuTimer> timer;
    std::unique_ptr<Renderer> renderer;

    /// Animates to `time` and draws one frame.
    void draw(const View& view, double time);
    /// Timer mode that is right for this driver: queries on real ones, finish-to-finish on software rasterisers.
    [[nodiscard]] gl::TimerMode timer_mode() const;
};

/// The view of a scene camera (its node's current transform). Throws UsageError listing the cameras.
[[nodiscard]] View camera_view(const Scene& scene, const std::string& name, float aspect);

/// A settings preset: a name in assets/presets, or a path.
void apply_preset(SettingsSet& settings, const std::string& name_or_path);
[[nodiscard]] std::vector<std::string> preset_names();

}  // namespace tyndall
