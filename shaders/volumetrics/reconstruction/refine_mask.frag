// Where a lower resolution is too coarse for density grids, which no depth buffer knows: depth 1 where the low pixels around are
// not on a line, in a row, a column or a diagonal of three, for then there is an edge between them, or detail. They are not where the second difference
// is more than `tolerance` of transmittance; or of light, relative to the brightest of the three and as far as the medium there
// is opaque. Light: of all TEXTURES together.
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/reconstruction/depth_weight.glsl"

layout(binding = 0) uniform sampler2D low_depth_texture;  // depth_downsample.frag
layout(binding = 1) uniform sampler2D values[TEXTURES];   // of the first: a transmittance
uniform int factor;  // pixels of the host along each side of a low one
uniform float tolerance;

const float SAME_SURFACE = 0.1;  // most that view depth differs, relative

struct LowPixel {
    float light;
    float transmittance;
    float depth;
};

LowPixel low_pixel(ivec2 at) {
    at = clamp(at, ivec2(0), textureSize(low_depth_texture, 0) - 1);
    LowPixel pixel = LowPixel(0.0, texelFetch(values[0], at, 0).a, texelFetch(low_depth_texture, at, 0).r);
    for (int k = 0; k < TEXTURES; ++k) pixel.light += dot(texelFetch(values[k], at, 0).rgb, vec3(1.0 / 3.0));
    count_work(WORK_TEXTURE_FETCHES, uint(1 + TEXTURES));
    return pixel;
}

bool bends(LowPixel a, LowPixel b, LowPixel c) {
    if (max(depth_difference(a.depth, b.depth), depth_difference(c.depth, b.depth)) > SAME_SURFACE) return false;
    float brightest = max(max(a.light, b.light), c.light);
    float opacity = 1.0 - min(min(a.transmittance, b.transmittance), c.transmittance);
    return abs(a.transmittance - 2.0 * b.transmittance + c.transmittance) > tolerance ||
           abs(a.light - 2.0 * b.light + c.light) * opacity > tolerance * brightest;
}

void main() {
    ivec2 own = ivec2(gl_FragCoord.xy) / factor;
    LowPixel middle = low_pixel(own);
    bool bent = false;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1))[i];
        bent = bends(low_pixel(own - step), middle, low_pixel(own + step)) || bent;
    }
    gl_FragDepth = bent ? 1.0 : 0.0;
    flush_work();
}
