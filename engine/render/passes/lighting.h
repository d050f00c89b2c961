#pragma once

#include <functional>
#include <vector>

#include "engine/render/frame_context.h"
#include "engine/render/passes/gbuffer.h"

namespace tyndall {

/// What surfaces and media are lit by, made by the passes before.
struct LightSources {
    TextureRef sky;  ///< radiance cube
    std::vector<TextureRef>
        textures;                    ///< shadow maps and the ambient cube: what shadow_lookup and light_data sample
    std::vector<BufferRef> buffers;  ///< and read
    std::function<void()> bind;      ///< binds those and the frame block
    /// Of the axes of lighting and transparents, those that modules set: 0 is what is not here.
    Permutation defines;
};

/// Adds the pass "lighting": the radiance of all surfaces in the G-buffer, black where there is none. Returns the
/// new version of `color` (RGBA16F).
[[nodiscard]] TextureRef add_lighting(FrameContext& frame, const GBuffer& gbuffer, const LightSources& sources,
                                      TextureRef color);

}  // namespace tyndall
