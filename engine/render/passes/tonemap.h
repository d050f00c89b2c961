#pragma once

#include "engine/render/frame_context.h"

namespace tyndall {

/// Adds the pass "tonemap": exposure, tone curve, sRGB, dither. Returns the new version of `display` (RGBA8).
[[nodiscard]] TextureRef add_tonemap(FrameContext& frame, TextureRef color, TextureRef display);

/// Factor from luminance (cd/m²) to the tonemap's input, where 1 saturates a sensor: 1 / (1.2 * 2^EV100), EV100 at
/// ISO 100 (Lagarde and de Rousiers 2014, section 5.1), and `bias` stops more light.
[[nodiscard]] float exposure_factor(float ev100, float bias);

}  // namespace tyndall
