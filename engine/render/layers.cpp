#include "engine/render/layers.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/gl/readback.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/depth.glsl"
#include "shaders/lib/octahedral.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

Image per_pixel(const Image& from, int channels, const std::function<void(const float* in, float* out)>& convert) {
    Image to(from.size, channels);
    for (int y = 0; y < from.size.y; ++y)
        for (int x = 0; x < from.size.x; ++x) convert(from.at(x, y), to.at(x, y));
    return to;
}

/// From red to green; `shares` may be of a lower resolution than the frame.
Image acceptance(const Image& shares, glm::ivec2 size) {
    Image to(size, 3);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 texel = (2 * glm::ivec2(x, y) + 1) * shares.size / (2 * size);
            const float share = *shares.at(texel.x, texel.y);
            to.at(x, y)[0] = 1 - share;
            to.at(x, y)[1] = share;
        }
    return to;
}

float srgb_decode(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

Image decode_layer(const std::string& layer, const gl::TextureView& texture, const LayerSource& source) {
    if (!texture) {
        Image image(source.size, 3);
        std::ranges::fill(image.pixels, layer == "transmittance" ? 1.0f : 0.0f);
        return image;
    }
    const Image raw = gl::read_texture(texture);
    if (layer == "depth")
        return per_pixel(raw, 1, [&](const float* in, float* out) {
            *out = glsl::is_background(*in) ? 0.0f : glsl::view_depth_from_buffer(*in, source.znear);
        });
    if (layer == "normal")
        return per_pixel(raw, 3, [](const float* in, float* out) {
            const bool sky = in[0] == 0 && in[1] == 0;  // the clear value, a corner that no normal is stored in
            const glm::vec3 n = sky ? glm::vec3(0) : glsl::octahedral_decode({in[0], in[1]});
            std::copy_n(&n.x, 3, out);
        });
    if (layer == "albedo")
        return per_pixel(raw, 3, [](const float* in, float* out) { std::transform(in, in + 3, out, srgb_decode); });
    if (layer == "acceptance") return acceptance(raw, source.size);
    if (source.in_alpha) return per_pixel(raw, 3, [](const float* in, float* out) { std::fill_n(out, 3, in[3]); });
    return per_pixel(raw, 3, [](const float* in, float* out) { std::copy_n(in, 3, out); });
}

}  // namespace tyndall
