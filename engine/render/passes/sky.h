#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/gl/texture.h"
#include "engine/render/frame_context.h"

namespace tyndall {

/// The procedural sky (shaders/engine/sky_model.glsl) that belongs to the scene's brightest sun, at night without
/// one: a cube of its radiance, with mips for reflections, and a cube of irradiance / pi. Both are drawn again only
/// when the sun changed.
class SkyPass {
  public:
    struct Output {
        TextureRef radiance, irradiance;
    };
    /// Adds sky/cube and sky/irradiance, or says why not.
    Output add(FrameContext& frame);
    /// Fills the pixels of `color` where `depth` is empty; returns its new version.
    [[nodiscard]] TextureRef add_background(FrameContext& frame, const Output& sky, TextureRef depth,
                                            TextureRef color);
    [[nodiscard]] std::uint64_t key() const;  ///< of what add() is for: changes with the sky
    void bind_ambient() const;                ///< the irradiance cube, at UNIT_AMBIENT

  private:
    struct Sun {
        glm::vec3 to_sun{0};   ///< unit
        float illuminance{0};  ///< lux; 0: none
        float light_unit{1};   ///< see Scene
        friend bool operator==(const Sun&, const Sun&) = default;
    };
    void add_cube(FrameContext& frame, Output& sky);
    void add_irradiance(FrameContext& frame, Output& sky);
    gl::Texture radiance_, irradiance_;
    Sun sun_, drawn_, irradiance_drawn_;
};

}  // namespace tyndall
