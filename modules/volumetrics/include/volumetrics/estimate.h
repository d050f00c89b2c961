#pragma once

#include <functional>
#include <string>
#include <vector>

#include "volumetrics/outputs.h"

namespace tyndall::volumetrics {

struct Pass;

/// How the samples that a texture was made of are placed, and so what noise it has: none, for it is a closed form
/// or lies on a grid; noise from frame to frame, which a mean over frames takes away; or noise from pixel to pixel
/// too (the settings noise and noise_time), which a spatial filter takes away as well.
enum class Sampling { exact, per_frame, per_pixel };

/// Light that is estimated apart from the rest: radiance = light * visible share.
struct Part {
    TextureRef light;  ///< RGBA16F: rgb unshadowed radiance, without noise
    TextureRef share;  ///< RGBA16F: rgb visible share 0 … 1; a = 1, or all 0 where there is no light
    Sampling sampling = Sampling::per_pixel;  ///< of `share`
};

/// What a technique gives: a rest, and parts of the light beside it. Noise, history, filters, up-sampling and
/// relighting (src/reconstruction) work on these textures by number and know neither sun nor lamps; of what is
/// exact they change nothing. Each texture has Frame::size or the host's size; what is sampled has Frame::size.
struct Estimate {
    TextureRef scattering;  ///< RGBA16F: rgb radiance of what is in no part, a mean transmittance; empty: no light
    TextureRef transmittance;  ///< RGBA16F where some medium's extinction is coloured; else scattering.a is for all
    Sampling sampling = Sampling::exact;  ///< of these two
    std::vector<Part> parts;              ///< at most most_parts
    Fog fog;                              ///< for transparents, where the technique has it
    TextureRef samples = {};              ///< Outputs::samples
    /// A pass of that name that draws these textures at the host's size, to that depth: scattering, transmittance,
    /// then of each part its light and its share; without targets yet. Empty: there is none.
    std::function<Pass(const std::string& name, TextureRef depth)> redraw;
    explicit operator bool() const { return static_cast<bool>(scattering); }
};

inline constexpr std::size_t most_parts = 3;

}  // namespace tyndall::volumetrics
