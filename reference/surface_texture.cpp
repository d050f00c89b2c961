#include "reference/surface_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall::reference {
namespace {

/// IEC 61966-2-1.
double srgb_decode(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::array<double, 256> decode_table(bool srgb) {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double v = static_cast<double>(i) / 255;
        table[i] = srgb ? srgb_decode(v) : v;
    }
    return table;
}

/// The two texels beside a coordinate, and the second one's weight.
struct Taps {
    std::array<std::size_t, 2> texel;
    double weight;
};

Taps taps(double coordinate, int size, Wrap wrap, bool nearest) {
    const double x = coordinate * size - (nearest ? 0 : 0.5), cell = std::floor(x);
    return {{texel_of(cell, size, wrap), texel_of(cell + 1, size, wrap)}, nearest ? 0 : x - cell};
}

template <class Texel>
auto bilinear(const Picture& picture, dvec2 uv, Texel texel) {
    const Sampling& how = picture.sampling;
    const Taps x = taps(uv.x, picture.size.x, how.u, how.nearest),
               y = taps(uv.y, picture.size.y, how.v, how.nearest);
    const auto at = [&](std::size_t i, std::size_t j) {
        const std::size_t row = y.texel[j] * static_cast<std::size_t>(picture.size.x);
        return texel(&picture.rgba[(row + x.texel[i]) * 4]);
    };
    return (at(0, 0) * (1 - x.weight) + at(1, 0) * x.weight) * (1 - y.weight) +
           (at(0, 1) * (1 - x.weight) + at(1, 1) * x.weight) * y.weight;
}

}  // namespace

std::size_t texel_of(double place, int size, Wrap wrap) {
    double texel = place;
    if (wrap != Wrap::clamp) {
        const double period = wrap == Wrap::mirror ? 2.0 * size : size;
        texel = place - period * std::floor(place / period);
        if (texel >= size) texel = period - 1 - texel;
    }
    // Rounding of enormous places may leave the range.
    return static_cast<std::size_t>(std::clamp(texel, 0.0, size - 1.0));
}

dvec4 sample(const Picture& picture, dvec2 uv, bool srgb) {
    static const std::array<double, 256> linear = decode_table(false), decoded = decode_table(true);
    const std::array<double, 256>& table = srgb ? decoded : linear;
    return bilinear(picture, uv, [&](const std::uint8_t* rgba) {
        return dvec4(table[rgba[0]], table[rgba[1]], table[rgba[2]], linear[rgba[3]]);
    });
}

dvec4 base_color(const Scene& scene, const Material& material, dvec2 uv, dvec4 vertex_color) {
    const dvec4 color = dvec4(material.base_color) * vertex_color;
    if (material.base_color_picture < 0) return color;
    return color * sample(scene.pictures[static_cast<std::size_t>(material.base_color_picture)], uv, true);
}

double mask_alpha(const Scene& scene, const Material& material, dvec2 uv) {
    const double factor = material.base_color.a;
    if (material.base_color_picture < 0) return factor;
    const Picture& picture = scene.pictures[static_cast<std::size_t>(material.base_color_picture)];
    return factor * bilinear(picture, uv, [](const std::uint8_t* rgba) { return rgba[3] / 255.0; });
}

}  // namespace tyndall::reference
