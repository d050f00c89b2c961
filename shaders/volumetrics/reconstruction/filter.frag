// One direction of a separable filter of 2 radius + 1 taps, of TEXTURES textures alike. DEPTH 0 knows no depth, 1
// weighs taps by their depth against the pixel's, 2 also by their depth against the plane that the pixel lies in.
// Taps outside of the picture are left out, and the rest is renormalised. NARROWS: see narrowing().
#include "shaders/lib/work.glsl"
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/reconstruction/depth_weight.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
#if NARROWS
layout(binding = 1) uniform sampler2D frames_texture;  // y frames in the mean that the pixel is, at least 1
uniform float kernel_variance;                         // px²
#endif
layout(binding = 2) uniform sampler2D values[TEXTURES];
uniform int radius;        // at most 7 px
uniform vec4 weights_0_3;  // by distance from the centre, px; the first is positive
uniform vec4 weights_4_7;
uniform vec2 texel;      // in uv
uniform vec2 direction;  // of the filter, (1, 0) or (0, 1)
uniform float depth_falloff;
uniform float slope_stride;     // px between the depths that make a slope
uniform float slope_tolerance;  // px by whose slope depths of one plane may be off it

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 results[TEXTURES];

float inside(vec2 p) {
    vec2 in_axis = step(abs(p - 0.5), vec2(0.5));
    return in_axis.x * in_axis.y;
}

float depth_at(vec2 p) { return textureLod(depth_texture, p, 0.0).r; }

#if DEPTH == 2
// Depth for slopes: sky and what is out of the picture is so far off that it makes a plane with nothing.
float surface_at(vec2 p) {
    float d = depth_at(p);
    return d > 0.0 && inside(p) > 0.0 ? d : -1.0e6;
}

// Takes the slope and the bend of three depths in line, if their two differences are alike (within a fifth: a plane's
// are the same, those of a stair of three surfaces may be near it) and more so than those known.
void try_plane(float d0, float d1, float d2, inout float slope, inout float bend) {
    float first = d1 - d0, second = d2 - d1;
    float new_bend = abs(second - first);
    if (10.0 * new_bend > abs(first + second) || new_bend >= bend) return;
    bend = new_bend;
    slope = 0.5 * (first + second);
}

// Change of buffer depth from pixel to pixel along `texel_step`, of the plane that a pixel of depth d > 0 lies in: of the
// three neighbouring depths, itself among them, that bend least (as ENO schemes choose their stencils: Harten et al. 1987).
// So one side of a silhouette is enough. 0 where no three make a plane: on what is one or two pixels wide.
float plane_slope(float d, vec2 texel_step) {
    vec2 far = texel_step * slope_stride;
    float d_2 = surface_at(uv - 2.0 * far), d_1 = surface_at(uv - far);
    float d1 = surface_at(uv + far), d2 = surface_at(uv + 2.0 * far);
    count_work(WORK_TEXTURE_FETCHES, 4u);
    float slope = 0.0, bend = 1.0e9;
    try_plane(d_1, d, d1, slope, bend);
    try_plane(d_2, d_1, d, slope, bend);
    try_plane(d, d1, d2, slope, bend);
    return slope / slope_stride;
}
#endif

#if NARROWS
// Noise in the mean over n frames falls, what a wide kernel smears stays. An edge's squared error grows with the width
// sigma, that of noise of variance 1 / n falls with sigma² in two directions: their sum is least for sigma ~ n^(-1/3). A
// kernel of variance v is taken to be right for one frame, or a wider one of 6 px² (of 4 px²: up to 4% less error, and in
// skies one sees the lattice of Bayer noise). Taps are weighed by exp(-k x²) as well, which makes of a Gaussian kernel one
// of variance max(v, 6 px²) / n^(2/3), but not less than the least. k = 0, the kernel as it is, where it is not wider than
// that: always at n = 1.
const float variance_of_one_frame = 6.0, least_variance = 0.25;  // px²
float narrowing() {
    float n = max(texelFetch(frames_texture, ivec2(gl_FragCoord.xy), 0).y, 1.0);
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float inverse = pow(n, 2.0 / 3.0) / max(kernel_variance, variance_of_one_frame);
    return 0.5 * max(min(inverse, 1.0 / least_variance) - 1.0 / kernel_variance, 0.0);
}
#endif

void main() {
    int reach = radius;
#if NARROWS
    float narrow = narrowing();
    // As far as exp(-k x²) > 1 / 512.
    reach = min(radius, int(sqrt(6.24 / max(narrow, 1.0e-3))));
#endif
    vec4 sums[TEXTURES];
    for (int k = 0; k < TEXTURES; ++k) sums[k] = textureLod(values[k], uv, 0.0) * weights_0_3.x;
    float total = weights_0_3.x;
#if DEPTH
    float d = depth_at(uv);
#endif
#if DEPTH == 2
    float slope = 0.0, allowed = 0.0;
    if (d > 0.0) {
        slope = plane_slope(d, texel * direction);
        if (slope_tolerance > 0.0) allowed = slope_tolerance * (abs(slope) + abs(plane_slope(d, texel * direction.yx)));
    }
#endif
    for (int i = 1; i <= reach; ++i) {
        float spatial = i < 4 ? weights_0_3[i] : weights_4_7[i - 4];
#if NARROWS
        spatial *= exp(-narrow * float(i * i));
#endif
        for (int side = -1; side <= 1; side += 2) {
            float offset = float(i * side);
            vec2 p = uv + texel * direction * offset;
            float weight = spatial * inside(p);
#if DEPTH
            float tap = depth_at(p);
            float alike = depth_weight(d, tap, depth_falloff);
#if DEPTH == 2
            float on_plane = d + slope * offset;
            on_plane = clamp(tap, on_plane - allowed, on_plane + allowed);
            if (tap > 0.0) alike = max(alike, depth_weight(on_plane, tap, depth_falloff));
#endif
            weight *= alike;
#endif
            for (int k = 0; k < TEXTURES; ++k) sums[k] += textureLod(values[k], p, 0.0) * weight;
            total += weight;
        }
    }
    count_work(WORK_TEXTURE_FETCHES, uint((2 * reach + 1) * TEXTURES));
#if DEPTH
    count_work(WORK_TEXTURE_FETCHES, uint(2 * reach + 1));
#endif
    for (int k = 0; k < TEXTURES; ++k) results[k] = round_to_half(sums[k] / total);
    flush_work();
}
