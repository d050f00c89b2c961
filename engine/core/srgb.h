#pragma once

#include <cmath>

namespace tyndall {

/// The sRGB transfer curve of one channel (IEC 61966-2-1), 0..1.
[[nodiscard]] inline float srgb_encode(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}
[[nodiscard]] inline float srgb_decode(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace tyndall
