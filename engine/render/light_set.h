#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/gl/texel_buffer.h"
#include "engine/render/lamps.h"
#include "shaders/shared/lights.h"

namespace tyndall {

/// A lamp or further sun as shaders read it. `pose` is its node's; the lamp shines along -Z. `first_tile` is its
/// first tile in the shadow atlas, -1: no shadow.
[[nodiscard]] shared::GpuLight gpu_light(const Light& light, const glm::mat4& pose, int first_tile);

/// Centre (world, m) and radius of the smallest sphere around what a lamp reaches: its range, within its cone.
[[nodiscard]] glm::vec4 reach(const shared::GpuLight& light);

/// The lamps of a frame as shaders read them, in the order of FrameFacts::lamps.
class LightSet {
  public:
    /// Without shadow tiles; intensities in units of Scene::light_unit().
    void update(const Scene& scene, std::span<const Lamp> lamps);
    /// `first_tile(scene light)` as ShadowAtlasPass gives it.
    void set_shadow_tiles(const std::function<int(std::size_t)>& first_tile);
    /// Sends the lamps to the GPU.
    void upload();
    void bind() const;  ///< at IMAGE_LIGHTS

    [[nodiscard]] std::span<const shared::GpuLight> lights() const { return lights_; }
    [[nodiscard]] GLuint buffer() const { return buffer_.id(); }

  private:
    std::vector<shared::GpuLight> lights_;
    std::vector<std::size_t> scene_index_;  ///< of each of lights_
    gl::TexelBuffer buffer_;
};

}  // namespace tyndall
