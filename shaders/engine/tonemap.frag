// Exposure, tone curve, sRGB, and an ordered dither of one 8-bit step against banding.
#include "shaders/engine/frame_block.glsl"
#include "shaders/lib/tonemap.glsl"

layout(location = 0) out vec4 display;
layout(binding = 0) uniform sampler2D color;

// Bayer's 8 x 8 matrix as (0.5 .. 63.5) / 64 by interleaving the bits of x ^ y and y.
float bayer(uvec2 p) {
    uint x = p.x ^ p.y;
    uint v = ((x & 1u) << 5) | ((p.y & 1u) << 4) | ((x & 2u) << 2) | ((p.y & 2u) << 1) | ((x & 4u) >> 1) |
             ((p.y & 4u) >> 2);
    return (float(v) + 0.5) / 64.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 shown = tonemap(texelFetch(color, pixel, 0).rgb * frame.exposure.x);
    vec3 encoded = vec3(srgb_encode(shown.r), srgb_encode(shown.g), srgb_encode(shown.b));
    display = vec4(encoded + (bayer(uvec2(pixel)) - 0.5) / 255.0, 1.0);
}
