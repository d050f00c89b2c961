#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/output_files.h"
#include "engine/core/settings.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"

namespace CLI {
class App;
}

namespace tyndall {

/// What is drawn, how large and with which settings: the options of every command that makes pictures.
struct SceneOptions {
    std::string scene;
    std::string size;
    std::optional<std::string> animation, media, add_media, technique, preset;
    std::vector<std::string> set;

    /// Adds the options to a command; the scene is required unless it has a default.
    void add_to(CLI::App& command, const std::string& default_scene, const std::string& default_size);
    [[nodiscard]] glm::ivec2 pixels() const;  ///< throws UsageError unless "WxH" within 1..16384
    void apply(SettingsSet& settings) const;  ///< preset, then technique, then `set`; throws UsageError or Error
    [[nodiscard]] std::vector<NamedFile> inputs() const;  ///< the files that they name
    [[nodiscard]] Scene load()
        const;  ///< with its media and at least one camera, at time 0; throws Error or UsageError
};

/// From where, and when.
struct ViewOptions {
    std::optional<std::string> camera;
    std::vector<double> eye, look;
    std::optional<double> fov;   ///< degrees, vertical
    std::optional<double> time;  ///< s

    void add_to(CLI::App& command);
    void check() const;  ///< throws UsageError: what excludes or needs each other, and a view without direction
    /// Of a scene at `time`. Throws UsageError.
    [[nodiscard]] View view(const Scene& scene, glm::ivec2 size) const;
};

/// The view of a scene camera (its node's current transform). Throws UsageError listing the cameras, and Error for
/// a camera whose node leaves it no place or direction.
[[nodiscard]] View camera_view(const Scene& scene, const std::string& name, float aspect);

/// Throws UsageError, which names the option, unless a picture can be written under this name.
void check_picture_name(const std::string& option, const std::filesystem::path& path);

/// A settings preset: a name in assets/presets, or a path.
void apply_preset(SettingsSet& settings, const std::string& name_or_path);
[[nodiscard]] std::vector<std::string> preset_names();

}  // namespace tyndall
