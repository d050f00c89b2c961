#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/settings.h"
#include "engine/platform/gl_context.h"
#include "engine/render/renderer.h"
#include "engine/scene/scene.h"
#include "session/scene_options.h"
#include "session/startup.h"

namespace tyndall {

/// The options that every command which draws with GL shares.
struct DrawOptions : SceneOptions {
    std::string context = "auto";
    void add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size);
};

/// A scene with its settings, ready to be drawn: what `play`, `render` and `flythrough` have in common.
/// Construction order: settings (usage errors first), context, scene, renderer.
class Session {
  public:
    /// What is about to be done, while context and shaders are there already.
    using Announce = std::function<void(Session&, const std::string& doing)>;
    /// Adds to the scene before it is uploaded.
    using Furnish = std::function<void(Scene&)>;
    /// `window` asks for a visible one. Throws UsageError or Error.
    Session(const DrawOptions& options, bool window, const Announce& announce = {}, const Furnish& furnish = {});

    SettingsSet settings;  ///< those of `options` and of `volumetrics`, by key
    FrameOptions options;
    Scene scene;
    glm::ivec2 size;
    std::unique_ptr<GlContext> context;
    std::unique_ptr<ShaderLibrary> shaders;
    std::unique_ptr<gl::GpuTimer> timer;
    VolumetricsAdapter volumetrics;
    std::unique_ptr<Renderer> renderer;
    Startup startup;  ///< until the first frame is drawn

    /// Draws one frame of the scene as it is at `time`.
    void draw(const View& view, double time);
    /// Timer mode that is right for this driver: queries on real ones, finish-to-finish on software rasterisers.
    [[nodiscard]] gl::TimerMode timer_mode() const;
    /// FrameOptions::layer is one of them.
    [[nodiscard]] static std::vector<std::string> layer_names();

  private:
    bool started_ = false;  ///< a frame was drawn
};

}  // namespace tyndall
