#pragma once

#include <map>
#include <memory>

#include "engine/render/light_set.h"
#include "engine/render/passes/shadow_atlas.h"
#include "engine/render/passes/shadow_sun.h"
#include "support/box_scene.h"
#include "support/gl_test.h"

namespace tyndall {

/// Runs the shadow passes on a scene and asks shaders/engine/shadow_lookup.glsl and shadow_occluder.glsl about
/// points.
class ShadowRig {
  public:
    explicit ShadowRig(Scene scene_);

    Scene scene;
    RenderSettings settings;
    View view = look_at({0, 2, 8}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);

    /// One frame: all lamps are in view unless `in_view` says which.
    void frame();
    void frame(std::span<const std::size_t> in_view);

    struct Point {
        glm::vec3 world;
        float view_depth = 0;  ///< sun: picks the cascade
        glm::vec3 normal{0, 1, 0};
        float light = -1;  ///< scene index of a lamp
    };
    enum class Lookup { sun_surface, sun_volume, light_surface, light_volume, sun_occluder, light_occluder };
    [[nodiscard]] std::vector<float> look_up(Lookup lookup, std::span<const Point> points);
    /// Shadow lookups that the instrumented shader counts for these points.
    [[nodiscard]] std::uint64_t counted(Lookup lookup, std::span<const Point> points);
    [[nodiscard]] float view_depth(glm::vec3 world) const { return -(view.view * glm::vec4(world, 1)).z; }

    [[nodiscard]] bool ran(const std::string& pass) const;
    [[nodiscard]] int ran_with_prefix(const std::string& prefix) const;
    [[nodiscard]] std::string skip_reason(const std::string& pass) const;

    shared::FrameData data{};
    ShadowSunPass::Output sun_output;
    ShadowAtlasPass::Output atlas_output;

  private:
    [[nodiscard]] const gl::Program& program(Lookup lookup, bool count_work);
    void dispatch(const gl::Program& program, std::span<const Point> points, gl::Buffer& results);

    ShaderLibrary& shaders_ = shared_shaders();
    GpuScene gpu_;

  public:
    ShadowSunPass sun;
    ShadowAtlasPass atlas;

  private:
    TransientPool pool_;
    std::unique_ptr<PassList> passes_;
    std::map<std::pair<Lookup, bool>, gl::Program> programs_;
    gl::Buffer frame_buffer_;
    gl::TexelBuffer light_buffer_;
};

/// The text of a compute shader that includes shadow_occluder.glsl, with `defines` before and `main` after it.
[[nodiscard]] std::string shadow_shader(const std::string& defines, const std::string& main);

}  // namespace tyndall
