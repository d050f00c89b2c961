// The share of the sun's light over a view ray that is not in shadow, estimated on screen, after Mitchell, "Volumetric Light
// Scattering as a Post-Process", GPU Gems 3, chapter 13: by a march from the pixel to the sun. Nothing but the depth buffer
// tells of occluders; an empty screen gives 1. See radial_shafts.frag for what it is good for.
//
// From a point of the view ray at view depth z the way to the sun appears on screen as the line from the pixel (u = 0) to
// the sun (u = 1), and 1/z falls linearly along it: at u it is at z / (1 - u). Against a surface seen there at depth d:
//     z < d (1 - u)  the way passes in front of it;    z = d (1 - u)  it meets it.
// INTERVALS 0 (GPU Gems): the share of samples that something covers, weighted by decay^u, is in shadow. Something covers a
//     sample if it is nearer than the way from the pixel's own surface: what lies behind that way casts no shadow on the ray.
//     Derived for a thin wall across the view and thin fog, where it is exact with decay 1: there equal parts of u are
//     met by the light of equal parts of the ray.
// INTERVALS 1: what is seen is a thin shell. The samples of one surface, from u_i to u_j, shadow the points of the ray
//     between d_i (1 - u_i) and d_j (1 - u_j). 32 parts of the ray, each with an equal share of the sun's light, are marked so.
//
// Where the sun leaves the screen the visibility fades to the setting radial_unseen, over half of the screen's half width;
// from there on, and with the sun behind the camera, it is that.
#define HAS_SUN 1
#define RAYLEIGH 0
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/techniques/fog.glsl"
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec3 sun_clip;  // x, y, w
layout(location = 0) out vec4 out_share;

const float FADE = 0.5;  // beyond the border, in half widths of the screen

// 1 with the sun on screen, 0 from FADE beyond it and behind the camera.
float sun_on_screen() {
    float w = sun_clip.z;
    if (w <= 0.0) return 0.0;
    return 1.0 - smoothstep(w, (1.0 + FADE) * w, max(abs(sun_clip.x), abs(sun_clip.y)));
}

// The march on screen, with the sun in front of the camera.
struct Line {
    vec2 begin;  // 0..1
    vec2 end;    // of u = 1
    float reach; // u where it leaves the screen, at most 1
};

Line line_to_sun(vec2 uv) {
    vec2 end = sun_clip.xy / sun_clip.z * 0.5 + 0.5;
    vec2 way = end - uv;
    vec2 border = mix(vec2(0.0), vec2(1.0), greaterThan(way, vec2(0.0)));
    vec2 reach = abs(border - uv) / max(abs(way), 1.0e-6);
    return Line(uv, end, min(min(reach.x, reach.y), 1.0));
}

// Two depths belong to one surface if the nearer is more than this of the farther. A guess: samples are further apart
// than texels, and surfaces seen at a glancing angle go far in one step.
const float BETWEEN_TEXELS = 0.8;
const float BETWEEN_SAMPLES = 0.5;

bool is_one_surface(float depth_0, float depth_1, float ratio) {
    return min(depth_0, depth_1) > ratio * max(depth_0, depth_1);
}

// Between texels of one surface interpolated: buffer depth is linear over a plane on screen, which so cannot shadow
// itself. Else that of the nearest texel.
float depth_on_line(Line line, float u) {
    vec2 p = mix(line.begin, line.end, u) / volumetrics.target.zw - 0.5;
    vec2 corner = floor(p);
    vec2 f = p - corner;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    vec4 four = textureGather(depth_texture, (corner + 1.0) / volumetrics.target.xy);  // 01, 11, 10, 00
    vec2 low = min(four.xy, four.zw), high = max(four.xy, four.zw);
    if (is_one_surface(min(low.x, low.y), max(high.x, high.y), BETWEEN_TEXELS))
        return mix(mix(four.w, four.z, f.x), mix(four.x, four.y, f.x), f.y);
    vec2 row = f.y < 0.5 ? four.wz : four.xy;
    return f.x < 0.5 ? row.x : row.y;
}

#if INTERVALS
const uint PARTS = 32u;

// The sun's light from the eye up to a distance, relative to others on the ray.
float gathered(Ray ray, float t, Extinction sun_front) {
    Medium m = global_medium(ray.origin.y, ray.direction.y, t);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Extinction front = sun_front;
    SunSegment sun = sun_segment(ray, 0.0, t, medium_optics(m, t), front);
    return mean_channel(m.sigma_s * sun.effective_length);
}

struct Shares {
    Extinction sun_front;
    float depth;  // of the pixel's surface in the buffer
    float whole;
};

// The share gathered before the point of the ray whose way to the sun meets what the buffer holds at u.
float share_at(Ray ray, Shares shares, float depth, float u) {
    float at = depth / max(1.0 - u, 1.0e-6);
    if (at <= shares.depth || shares.whole <= 0.0) return 1.0;
    float t = ray_distance_from_view_depth(view_depth_from_buffer(at, volumetrics.eye.w), ray.forward_cosine);
    return clamp(gathered(ray, t, shares.sun_front) / shares.whole, 0.0, 1.0);
}

// The parts whose sample, `place` of the way into them, lies between two shares.
uint parts_between(float a, float b, float place) {
    int first = int(ceil(min(a, b) * float(PARTS) - place));
    int count = int(ceil(max(a, b) * float(PARTS) - place)) - first;
    return count > 0 ? bitfieldInsert(0u, ~0u, first, count) : 0u;
}

float visibility_on_screen(Ray ray, float depth, float surface) {
    Extinction sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
    Shares shares = Shares(sun_front, depth, gathered(ray, visible_end(ray.origin.y, ray.direction.y, surface), sun_front));
    Line line = line_to_sun(ray.uv);
    uint samples = uint(volumetrics.radial_samples);
    float offset = noise_offset(uvec2(gl_FragCoord.xy));
    float place = volumetrics.noise.x != NOISE_NONE ? fract(offset * 39.55) : 0.5;  // another sequence than the samples'
    uint shadowed = 0u;
    float u_before = 0.0, before = depth, share_before = 1.0;
    for (uint i = 0u; i <= samples; ++i) {
        // The last one is where the line ends: as its neighbour.
        float u = i < samples ? line.reach * (float(i) + offset) / float(samples) : line.reach;
        float here = i < samples ? depth_on_line(line, u) : before;
        float share = share_at(ray, shares, here, u);
        if (is_one_surface(before, here, BETWEEN_SAMPLES)) {
            shadowed |= parts_between(share_before, share, place);
        } else {
            float middle = 0.5 * (u_before + u);
            if (before > 0.0) shadowed |= parts_between(share_before, share_at(ray, shares, before, middle), place);
            if (here > 0.0) shadowed |= parts_between(share_at(ray, shares, here, middle), share, place);
        }
        u_before = u;
        before = here;
        share_before = share;
    }
    return 1.0 - float(bitCount(shadowed)) / float(PARTS);
}
#else
float visibility_on_screen(Ray ray, float depth, float surface) {
    Line line = line_to_sun(ray.uv);
    uint samples = uint(volumetrics.radial_samples);
    float offset = noise_offset(uvec2(gl_FragCoord.xy));
    float lit = 0.0, total = 0.0;
    for (uint i = 0u; i < samples; ++i) {
        float u = line.reach * (float(i) + offset) / float(samples);
        float weight = pow(volumetrics.radial_decay, u);
        float way = depth * (1.0 - u);  // buffer depth is near / view depth, and linear along the line
        if (depth_on_line(line, u) <= 1.001 * way) lit += weight;
        total += weight;
    }
    return lit / total;
}
#endif

void main() {
    vec2 uv = screen_place(gl_FragCoord.xy);
    Ray ray = view_ray(uv);
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    float on_screen = sun_on_screen();
    float visibility = volumetrics.radial_unseen;
    if (on_screen > 0.0) visibility = mix(visibility, visibility_on_screen(ray, depth, surface), on_screen);
    out_share = round_to_half(vec4(vec3(visibility), 1.0));
    flush_work();
}
