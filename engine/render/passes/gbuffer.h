#pragma once

#include <optional>

#include "engine/render/draw_list.h"
#include "engine/render/frame_context.h"

namespace tyndall {

struct GBuffer {
    TextureRef albedo;    ///< SRGB8_ALPHA8 base colour
    TextureRef normal;    ///< RG16 octahedral, world space, with the normal map
    TextureRef material;  ///< RGBA8 roughness, metallic, occlusion
    TextureRef emissive;  ///< RGBA16F cd/m²
    TextureRef depth;     ///< D32F reversed-Z; 0 is sky
    /// RG16F, or empty. Of the surface seen: its place on the screen now less that in the frame before, 0..1 of the
    /// picture, the camera's motion included; beyond -1..1 it was not in the picture; 0 on the sky.
    TextureRef motion;
};

/// Draws what the view sees of the scene's opaque and alpha-masked surfaces.
class GBufferPass {
  public:
    /// GBuffer::motion is made where the view-projection of the frame before is given and something that is drawn
    /// has moved since.
    GBuffer add(FrameContext& frame, const std::optional<glm::mat4>& previous_view_projection);
    [[nodiscard]] const DrawList& draws() const { return draws_; }

  private:
    void draw(const FrameContext& frame, const glm::mat4* previous_view_projection) const;
    DrawList draws_;
};

}  // namespace tyndall
