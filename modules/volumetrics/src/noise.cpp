#include "noise.h"

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/dither.glsl"
TYNDALL_GLSL_END

namespace tyndall::volumetrics {

std::vector<float> noise_tile(Noise noise, int size) {
    if (noise != Noise::bayer && noise != Noise::white_tile) return {0.5F};
    constexpr unsigned seed = 1;
    const int kind = noise == Noise::bayer ? glsl::DITHER_BAYER : glsl::DITHER_WHITE;
    const auto side = static_cast<unsigned>(size);
    std::vector<float> tile;
    for (unsigned y = 0; y < side; ++y)
        for (unsigned x = 0; x < side; ++x) tile.push_back(glsl::dither_offset(kind, {x, y}, side, seed));
    return tile;
}

int noise_side(const Settings& settings) {
    return settings.noise == Noise::bayer || settings.noise == Noise::white_tile ? settings.noise_size : 1;
}

}  // namespace tyndall::volumetrics
