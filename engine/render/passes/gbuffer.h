#pragma once

#include "engine/render/draw_list.h"
#include "engine/render/frame_context.h"

namespace tyndall {

struct GBuffer {
    TextureRef albedo;    ///< SRGB8_ALPHA8 base colour
    TextureRef normal;    ///< RG16 octahedral, world space, with the normal map
    TextureRef material;  ///< RGBA8 roughness, metallic, occlusion
    TextureRef emissive;  ///< RGBA16F cd/m²
    TextureRef depth;     ///< D32F reversed-Z; 0 is sky
};

/// Draws what the view sees of the scene's opaque and alpha-masked surfaces.
class GBufferPass {
  public:
    GBuffer add(FrameContext& frame);
    [[nodiscard]] const DrawList& draws() const { return draws_; }

  private:
    void draw(const FrameContext& frame) const;
    DrawList draws_;
};

}  // namespace tyndall
