#include "engine/render/layers.h"

#include <algorithm>
#include <cmath>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/depth.glsl"
#include "shaders/lib/octahedral.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

float srgb_decode(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Image albedo(const Image& texture, glm::ivec2) {
    return convert_pixels(texture, 3,
                          [](const float* in, float* out) { std::transform(in, in + 3, out, srgb_decode); });
}

Image normal(const Image& texture, glm::ivec2) {
    return convert_pixels(texture, 3, [](const float* in, float* out) {
        const bool sky = in[0] == 0 && in[1] == 0;  // the clear value, a corner that no normal is stored in
        const glm::vec3 n = sky ? glm::vec3(0) : glsl::octahedral_decode({in[0], in[1]});
        std::copy_n(&n.x, 3, out);
    });
}

Layer::Decode view_depth(float znear) {
    return [znear](const Image& texture, glm::ivec2) {
        return convert_pixels(texture, 1, [znear](const float* in, float* out) {
            *out = glsl::is_background(*in) ? 0.0f : glsl::view_depth_from_buffer(*in, znear);
        });
    };
}

}  // namespace

Image convert_pixels(const Image& from, int channels,
                     const std::function<void(const float* in, float* out)>& convert) {
    Image to(from.size, channels);
    for (int y = 0; y < from.size.y; ++y)
        for (int x = 0; x < from.size.x; ++x) convert(from.at(x, y), to.at(x, y));
    return to;
}

Image Layer::rgb(const Image& texture, glm::ivec2) {
    return convert_pixels(texture, 3, [](const float* in, float* out) { std::copy_n(in, 3, out); });
}

Image Layer::alpha(const Image& texture, glm::ivec2) {
    return convert_pixels(texture, 3, [](const float* in, float* out) { std::fill_n(out, 3, in[3]); });
}

std::vector<Layer> surface_layers(const GBuffer& gbuffer, float znear) {
    return {{.name = "depth", .texture = gbuffer.depth, .decode = view_depth(znear)},
            {.name = "albedo", .texture = gbuffer.albedo, .decode = albedo},
            {.name = "normal", .texture = gbuffer.normal, .decode = normal},
            {.name = "emissive", .texture = gbuffer.emissive, .is_light = true}};
}

}  // namespace tyndall
