#pragma once

#include <cstdint>
#include <span>

namespace tyndall {

/// Share of the RGBA texels whose alpha passes the cutoff (0..1).
[[nodiscard]] float alpha_coverage(std::span<const std::uint8_t> rgba, float cutoff);

/// Multiplies alpha so that the share of texels that pass the cutoff comes as near to `coverage` as one factor can
/// bring it. Averaging into mip levels pulls alpha towards its mean, and cut-out leaves vanish in the distance
/// without it (Castaño 2010, "Computing Alpha Mipmaps").
void scale_alpha_to_coverage(std::span<std::uint8_t> rgba, float cutoff, float coverage);

}  // namespace tyndall
