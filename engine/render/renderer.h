#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/image.h"
#include "engine/gl/query.h"
#include "engine/gl/texture.h"
#include "engine/gl/work_counters.h"
#include "engine/graph/pass_list.h"
#include "engine/render/frame_facts.h"
#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "engine/shader/shader_library.h"

namespace tyndall {

class FrameModule;

/// What one frame is drawn with besides the scene and the view.
struct FrameOptions {
    double time = 0;                ///< s
    std::uint32_t frame_index = 0;  ///< moves dither and noise patterns
    bool count_work = false;        ///< instrumented shaders; see Renderer::work
    /// What takes long, as the sky volume, is built over several frames; else all in the first that needs it.
    bool progressive = false;
    gl::GpuTimer* timer = nullptr;  ///< per-pass times; render() begins its frame and copies its results
    std::string layer = "color";    ///< the layer that read_layer may be asked for (layer_names)
    std::vector<std::string> more_layers = {};  ///< others that it may be asked for by name
    RenderSettings render;
};

/// Draws a scene deferred, into its own framebuffer: presenting is a blit of `display_framebuffer`. What else is to
/// be in the picture comes from modules.
///
///     Renderer renderer(shaders);
///     renderer.prepare(scene);
///     renderer.render(scene, view, size, options);   // each frame, after animate(scene, time)
///     context.present(renderer.display_framebuffer(), renderer.size());
///
/// A GL 4.5 context must be current in every call and on destruction.
class Renderer {
  public:
    /// `modules` outlive the renderer, each serves it alone, and they take their turns in this order.
    explicit Renderer(ShaderLibrary& shaders, std::vector<FrameModule*> modules = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Uploads meshes and pictures; call again for another scene. Throws Error when the driver's limits are
    /// exceeded.
    /// `anisotropy` of the material textures' filter: 4 is cheap on GPUs, and three times the G-buffer on llvmpipe.
    void prepare(const Scene& scene, float anisotropy = 4);
    /// Builds the frame's pass list and runs it. `scene` is the prepared one, with node transforms, lights and
    /// media of this instant. `size` in pixels, both at least 1. Throws Error: a shader that does not build, an
    /// unknown layer.
    void render(const Scene& scene, const View& view, glm::ivec2 size, const FrameOptions& options);
    /// The view jumps (a camera cut): nothing of earlier frames may show in the next.
    void invalidate_history();

    // Results, of the last render().
    [[nodiscard]] glm::ivec2 size() const;
    /// Framebuffer whose colour attachment 0 is display().
    [[nodiscard]] GLuint display_framebuffer() const;
    [[nodiscard]] gl::TextureView display() const;  ///< RGBA8, exposed, tonemapped and sRGB encoded
    [[nodiscard]] gl::TextureView color() const;    ///< RGBA16F, linear radiance in Scene::light_unit()
    /// What a player sees, 4 channels 0..1, row 0 at the top. Waits for the GPU.
    [[nodiscard]] Image read_display() const;
    /// FrameOptions::layer of the last frame, linear, 3 channels (depth: 1), row 0 at the top: color and emissive
    /// in cd/m²; depth as view depth in metres, 0 where there is only sky; albedo; normal in world space, 0 on the
    /// sky; and those of the modules.
    [[nodiscard]] Image read_layer() const;
    /// The same for one of FrameOptions::more_layers.
    [[nodiscard]] Image read_layer(const std::string& name) const;
    /// The renderer's own, and those that modules add.
    [[nodiscard]] static std::vector<std::string> layer_names(std::span<FrameModule* const> modules);

    [[nodiscard]] const FrameFacts& facts() const;
    [[nodiscard]] const PassList& passes() const;
    [[nodiscard]] const std::vector<gl::GpuTimer::Scope>& timings() const;
    /// Per pass, when count_work was set. Waits for the GPU.
    [[nodiscard]] std::vector<std::pair<std::string, gl::WorkCounts>> work() const;

    /// Bytes of transient and persistent render targets, shadow maps included; the scene's pictures are not.
    [[nodiscard]] std::size_t texture_bytes() const;

    /// Draw statistics of the G-buffer pass.
    struct DrawCounts {
        std::size_t instances = 0, triangles = 0, draw_calls = 0;
    };
    [[nodiscard]] DrawCounts draw_counts() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall
