#pragma once

#include <functional>
#include <vector>

#include "engine/render/frame_context.h"
#include "engine/render/layers.h"
#include "engine/render/passes/gbuffer.h"
#include "engine/render/passes/lighting.h"

namespace tyndall {

/// What a module adds to the frames of one renderer, which knows nothing else of it. While a frame's pass list is
/// built these functions are called in the order they have here; what they add may refer to the frame until it has
/// run.
class FrameModule {
  public:
    FrameModule() = default;
    virtual ~FrameModule() = default;
    FrameModule(const FrameModule&) = delete;
    FrameModule& operator=(const FrameModule&) = delete;

    /// Whether GBuffer::motion is to be made, where something moves.
    [[nodiscard]] virtual bool wants_motion(const FrameContext&) const { return false; }
    /// The G-buffer and the lights are there, no surface is lit yet. `lights` may be changed for surfaces: textures
    /// that they sample, what is bound, defines. `transparents`: boxes round what alpha-blended is in view.
    virtual void add_before_lighting(FrameContext& frame, const GBuffer& gbuffer,
                                     std::span<const Aabb> transparents, LightSources& lights) = 0;
    /// `color` (RGBA16F) holds the opaque surfaces and the sky; returns its new version.
    [[nodiscard]] virtual TextureRef add_after_lighting(FrameContext& frame, TextureRef color) = 0;

    /// What shaders/engine/transparent_blend.glsl needs of the module.
    struct Transparents {
        std::function<void(PassBuilder&)> declare;  ///< the textures that it samples; may be empty, as `bind`
        std::function<void(const PassContext&)> bind;
        Permutation defines;  ///< of the pass's axes; 0 is what is not here
    };
    [[nodiscard]] virtual Transparents transparents() const { return {}; }
    /// Adds a pass that takes the tonemap's place and returns the new version of `display` (RGBA8); empty: none.
    [[nodiscard]] virtual TextureRef add_display(FrameContext&, TextureRef /*display*/) { return {}; }
    /// By name, always the same ones; before the first frame without textures.
    [[nodiscard]] virtual std::vector<Layer> layers() const { return {}; }

    /// The view jumps (a camera cut): nothing of earlier frames may show in the next. What does not depend on the
    /// view may stay.
    virtual void forget_history() {}
};

}  // namespace tyndall
