#pragma once

#include <algorithm>
#include <cmath>

namespace tyndall {

struct FlipColor {
    float x, y, z;
};

// CIE XYZ over the white's, from linear sRGB: primaries of IEC 61966-2-1, white at x 0.31271, y 0.32902 as in the
// papers' implementation.
constexpr float flip_white_x = 0.9504285453771807f;
constexpr float flip_white_z = 1.0889003707981277f;

inline FlipColor relative_xyz(FlipColor rgb) {
    return {
        (0.4123865632529917f * rgb.x + 0.3575914909206254f * rgb.y + 0.1804504912035637f * rgb.z) / flip_white_x,
        0.2126368216773238f * rgb.x + 0.7151829818412507f * rgb.y + 0.0721801964814254f * rgb.z,
        (0.0193306201524840f * rgb.x + 0.1191971636402085f * rgb.y + 0.9503725870054354f * rgb.z) / flip_white_z};
}

/// The inverse, with what lies outside of the unit cube of linear sRGB brought to its faces.
inline FlipColor clamped_rgb(FlipColor c) {
    const float x = c.x * flip_white_x, y = c.y, z = c.z * flip_white_z;
    return {std::clamp(3.241003232976358f * x - 1.537398969488785f * y - 0.498615881996363f * z, 0.0f, 1.0f),
            std::clamp(-0.969224252202516f * x + 1.875929983695176f * y + 0.041554226340085f * z, 0.0f, 1.0f),
            std::clamp(0.055639419851975f * x - 0.204011206123910f * y + 1.057148977187533f * z, 0.0f, 1.0f)};
}

inline float lab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

/// CIELAB with the Hunt effect: chroma grows with lightness.
inline FlipColor hunt_lab(FlipColor relative) {
    const float x = lab_curve(relative.x), y = lab_curve(relative.y), z = lab_curve(relative.z);
    const float lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

/// Abasi et al. 2020: city-block in lightness, Euclidean in chroma.
inline float hyab(FlipColor a, FlipColor b) {
    return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

}  // namespace tyndall
