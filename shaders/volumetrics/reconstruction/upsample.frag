// From low to full resolution, TEXTURES textures alike: each pixel takes from the low pixels around it, of its own surface where the mode asks so.
//   bilinear       the 2x2 around.
//   bilateral      the same times depth_weight() (Tomasi and Manduchi 1998; Kopf et al. 2007).
//   nearest_depth  the same as bilinear where all four lie on the pixel's surface, else the one whose depth is most like the
//                  pixel's (after Jansen and Bavoil, "Fast rendering of opacity-mapped particles", 2011).
// A low pixel's depth is that of some pixel of its block. It is compared with the plane of buffer depth through the host
// pixel: it lies on it if it is between the least and greatest that the plane has in that block. So a floor seen at a
// grazing angle is one surface. Where none of the four is alike, the most alike of 3x3 is taken.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/reconstruction/depth_weight.glsl"

layout(binding = 0) uniform sampler2D depth_texture;      // of the host
layout(binding = 1) uniform sampler2D low_depth_texture;  // depth_downsample.frag
layout(binding = 2) uniform sampler2D values[TEXTURES];
uniform int factor;  // pixels of the host along each side of a low one
uniform int mode;    // Upsample
uniform float depth_falloff;

layout(location = 0) out vec4 results[TEXTURES];

const int NEAREST = 0, BILINEAR = 1, BILATERAL = 2;
const float SAME_SURFACE = 0.5;  // depth_weight() above which nearest_depth interpolates

// Centre of a low pixel's block, of which the border may have cut a part: px of the host.
vec2 centre_of(ivec2 low) {
    ivec2 begin = low * factor;
    return 0.5 * vec2(begin + min(begin + factor, textureSize(depth_texture, 0)));
}

struct Surface {
    vec2 place;  // px
    float depth;
    vec2 slope;  // of buffer depth, per px
};

float depth_at(ivec2 pixel) {
    return texelFetch(depth_texture, clamp(pixel, ivec2(0), textureSize(depth_texture, 0) - 1), 0).r;
}

// Beyond the border the surface goes on, if it is not steep: then an edge is as likely.
float slope_along(ivec2 pixel, ivec2 direction, float here) {
    float before = depth_at(pixel - direction), after = depth_at(pixel + direction);
    float gentle = 0.125 * here;
    if (any(lessThan(pixel - direction, ivec2(0))) && abs(after - here) < gentle) before = 2.0 * here - after;
    if (any(greaterThanEqual(pixel + direction, textureSize(depth_texture, 0))) && abs(here - before) < gentle)
        after = 2.0 * here - before;
    return depth_slope(before, here, after);
}

Surface surface_at(ivec2 pixel) {
    float depth = depth_at(pixel);
    count_work(WORK_TEXTURE_FETCHES, 5u);
    return Surface(vec2(pixel) + 0.5, depth,
                   vec2(slope_along(pixel, ivec2(1, 0), depth), slope_along(pixel, ivec2(0, 1), depth)));
}

// What the surface's plane has in the block of a low pixel, as near as can be to the depth there.
float depth_on_plane(Surface surface, ivec2 low, float there) {
    float middle = surface.depth + dot(surface.slope, centre_of(low) - surface.place);
    float reach = 0.5 * float(factor - 1) * (abs(surface.slope.x) + abs(surface.slope.y));
    float on_plane = clamp(there, middle - reach, middle + reach);
    return surface.depth > 0.0 && there > 0.0 ? max(on_plane, 1.0e-3 * surface.depth) : surface.depth;
}

float low_depth(ivec2 low) {
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return texelFetch(low_depth_texture, low, 0).r;
}

ivec2 most_alike(Surface surface, ivec2 own, ivec2 last) {
    ivec2 best = own;
    float least = 1.0e9;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 low = clamp(own + ivec2(x, y), ivec2(0), last);
            float there = low_depth(low);
            // Of those alike the one that is nearest on screen.
            float difference = depth_difference(depth_on_plane(surface, low, there), there) +
                               0.01 * distance(centre_of(low), surface.place) / float(factor);
            if (difference < least) {
                least = difference;
                best = low;
            }
        }
    return best;
}

void fetch(ivec2 low, float weight, inout vec4 sums[TEXTURES]) {
    for (int k = 0; k < TEXTURES; ++k) sums[k] += weight * texelFetch(values[k], low, 0);
    count_work(WORK_TEXTURE_FETCHES, uint(TEXTURES));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(low_depth_texture, 0) - 1;
    ivec2 own = pixel / factor;
    vec4 sums[TEXTURES];
    for (int k = 0; k < TEXTURES; ++k) sums[k] = vec4(0.0);
    float total = 1.0;
    if (mode == NEAREST) {
        fetch(own, 1.0, sums);
    } else {
        ivec2 low_0 = max(own - ivec2(lessThan(gl_FragCoord.xy, centre_of(own))), ivec2(0));
        ivec2 low_1 = min(low_0 + 1, last);
        vec2 place_0 = centre_of(low_0);
        vec2 share = clamp((gl_FragCoord.xy - place_0) / max(centre_of(low_1) - place_0, 0.5), 0.0, 1.0);
        ivec2 lows[4] = ivec2[](low_0, ivec2(low_1.x, low_0.y), ivec2(low_0.x, low_1.y), low_1);
        vec4 weights = vec4(1.0 - share.x, share.x, 1.0 - share.x, share.x) *
                       vec4(vec2(1.0 - share.y), vec2(share.y));
        if (mode != BILINEAR) {
            Surface surface = surface_at(pixel);
            vec4 alike;
            for (int i = 0; i < 4; ++i) {
                float there = low_depth(lows[i]);
                alike[i] = depth_weight(depth_on_plane(surface, lows[i], there), there, depth_falloff);
            }
            if (mode == BILATERAL) weights *= alike;
            total = dot(weights, vec4(1.0));
            bool none = mode == BILATERAL ? total < 1.0e-4 : any(lessThan(alike, vec4(SAME_SURFACE)));
            if (none) {
                lows[0] = most_alike(surface, own, last);
                weights = vec4(1.0, 0.0, 0.0, 0.0);
                total = 1.0;
            }
        }
        for (int i = 0; i < 4; ++i)
            if (weights[i] > 0.0) fetch(lows[i], weights[i], sums);
    }
    for (int k = 0; k < TEXTURES; ++k) results[k] = round_to_half(sums[k] / total);
    flush_work();
}
