// The setting temporal: mean over frames of the values s of each pixel in TEXTURES textures alike,
//     S_n = h + (s_n - h) (1 - k),
// h what is kept at the place where the surface seen in the pixel was in the frame before, s_n the new frame, and k the
// share of what is kept: 0 where that place was off screen, else with the acceptance A in 0..1
//     A (1 - W)       of blend, ema and acceptance, W the setting temporal_weight,
//     n / (n + 1)     of accumulate, n = min(n_before A, temporal_frames - 1).
// The surface lies at P' in the frame before, and the one seen there at P''. Both are on one ray, so that in view depth z
//     |P' - P''| / min(|P'|, |P''|) = max(z', z'') / min(z', z'') - 1 = D,    A = exp(-scale D).
// As a share of the distance it is the same in the middle of the screen and at its edge. P' is compared with each of the
// four pixels around its place, and with where the pixel's plane passes there: 1 / z is linear over a plane on screen, so
// that floors seen at grazing angles are accepted. CLIP and REJECT: see clipped() and change_of().
#include "shaders/lib/pack.glsl"
#include "shaders/lib/sampling_noise.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/reconstruction/depth_weight.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D surface_before;  // see out_surface
layout(binding = 2) uniform sampler2D motion_texture;
layout(binding = 3) uniform sampler2D values[2 * TEXTURES];  // now, then before; the first tells of changes
#define VALUES_NOW(k) values[k]
#define VALUES_BEFORE(k) values[TEXTURES + k]

uniform int taps;            // of what is kept: 0 there is nothing, 1 the pixel's own, 4 around its place before
uniform bool low;            // the target is of the chosen resolution, not of the host's
uniform bool motion;         // motion_texture is there
uniform bool by_depth;       // A is not always 1
uniform bool counted;        // accumulate
uniform float scale;
uniform float least_weight;  // W
uniform float most_frames;   // n + 1 at most
// The same, at least 1, as sun, media and lamps are known to have changed since the frame before.
uniform float known_frames;
uniform float travel;  // of the camera, over that after which nothing is known of light in front of what is far off
uniform int changed_lamp_count;
uniform vec4 changed_lamps[16];  // in whose range: xyz view space (m), w range (m)
uniform float changed_frames[16];
uniform uint frame;
uniform mat4 previous_clip_from_view;

// x 1 / view depth (1/m), 0 sky; y frames; of REJECT: z standard deviation, w mean of the last changes, in radiance.
layout(location = 0) out vec4 out_surface;
layout(location = 1) out vec4 results[TEXTURES];
layout(location = 1 + TEXTURES) out float out_acceptance;  // attached where it is asked for

struct Kept {
    vec4 values[TEXTURES];
    vec3 statistics;  // frames, standard deviation, mean of the last changes
    float acceptance;
};

// 1 / view depth of the surface in the pixel, and its slopes per pixel in x and y.
vec3 surface_of(ivec2 pixel, ivec2 size) {
    count_work(WORK_TEXTURE_FETCHES, 5u);
    ivec2 last = size - 1;
    float here = texelFetch(depth_texture, pixel, 0).r;
    float left = texelFetch(depth_texture, max(pixel - ivec2(1, 0), ivec2(0)), 0).r;
    float right = texelFetch(depth_texture, min(pixel + ivec2(1, 0), last), 0).r;
    float below = texelFetch(depth_texture, max(pixel - ivec2(0, 1), ivec2(0)), 0).r;
    float above = texelFetch(depth_texture, min(pixel + ivec2(0, 1), last), 0).r;
    return vec3(here, depth_slope(left, here, right), depth_slope(below, here, above)) / volumetrics.eye.w;
}

// 0..1 of the picture.
vec2 screen_size_of_texel() { return low ? volumetrics.target.zw : volumetrics.viewport.zw; }

// To view depth 1, in view space.
vec3 view_ray(vec2 screen) {
    vec4 near = volumetrics.inverse_projection * vec4(screen * 2.0 - 1.0, 1.0, 1.0);
    return near.xyz / -near.z;
}

// In texels, and 1 / view depth there over that here; z <= 0: behind the camera.
// Motion on screen tells nothing of depth: what moves is taken to keep its distance, as far as the camera does.
vec3 place_before(float inverse_depth) {
    vec2 screen_per_texel = screen_size_of_texel();
    vec2 screen = gl_FragCoord.xy * screen_per_texel;
    vec4 clip = previous_clip_from_view * vec4(view_ray(screen), inverse_depth);
    if (!(clip.w > 0.0)) return vec3(-1.0);
    vec2 before = 0.5 + 0.5 * clip.xy / clip.w;
    if (motion && inverse_depth > 0.0) {
        count_work(WORK_TEXTURE_FETCHES, 1u);
        vec2 moved = textureLod(motion_texture, screen, 0.0).xy;
        // Half floats: where only the camera moved, its own projection is more exact.
        vec2 tolerance = 0.1 * screen_per_texel + 0.002 * abs(moved);
        if (any(greaterThan(abs(screen - before - moved), tolerance))) before = screen - moved;
    }
    return vec3(before / screen_per_texel, 1.0 / clip.w);
}

// The camera's travel moves light in front of a surface at distance z against it by an angle that grows with 1 / z. Even
// in front of the sky that light is some 10 m off: travel (1 / z + 1 / 10 m).
float frames_known(float inverse_depth) {
    float frames = max(min(known_frames, 1.0 / max(travel * (1.0 + 10.0 * inverse_depth), 1.0e-6)), 1.0);
    if (changed_lamp_count == 0) return frames;
    vec3 ray = normalize(view_ray(gl_FragCoord.xy * screen_size_of_texel()));
    float far = inverse_depth > 0.0 ? 1.0 / (inverse_depth * -ray.z) : 1.0e9;
    for (int i = 0; i < changed_lamp_count; ++i) {
        vec3 lamp = changed_lamps[i].xyz;
        float nearest = distance(lamp, ray * clamp(dot(lamp, ray), 0.0, far));
        if (nearest < changed_lamps[i].w) frames = min(frames, changed_frames[i]);
    }
    return frames;
}

// D of the head comment, from 1 / view depth.
float relative_distance(float a, float b) {
    float least = min(a, b);
    float most = max(a, b);
    if (least <= 0.0) return most <= 0.0 ? 0.0 : 1.0e9;
    return most / least - 1.0;
}

// Not so for what is not a number.
bool is_usable(vec4 v, vec4 surface) {
    return all(lessThanEqual(abs(v), vec4(HALF_MAX))) && surface.y >= 1.0 && surface.y <= 256.0 &&
           surface.x >= 0.0;
}

Kept nothing_kept() {
    Kept nothing;
    for (int k = 0; k < TEXTURES; ++k) nothing.values[k] = vec4(0.0);
    nothing.statistics = vec3(0.0);
    nothing.acceptance = 0.0;
    return nothing;
}

Kept kept_at(vec2 place, float inverse_depth, vec2 slope, ivec2 size) {
    Kept sum = nothing_kept();
    if (any(lessThan(place, vec2(0.0))) || !all(lessThan(place, vec2(size)))) return sum;
    ivec2 base = taps == 1 ? ivec2(place) : ivec2(floor(place - 0.5));
    vec2 f = taps == 1 ? vec2(0.0) : place - 0.5 - vec2(base);
    float total = 0.0;
    for (int i = 0; i < taps; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = base + corner;
        vec2 side = mix(1.0 - f, f, vec2(corner));
        float weight = side.x * side.y;
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) continue;
        count_work(WORK_TEXTURE_FETCHES, uint(1 + TEXTURES));
        total += weight;
        vec4 surface = texelFetch(surface_before, texel, 0);
        vec4 before[TEXTURES];
        bool usable_all = true;
        for (int k = 0; k < TEXTURES; ++k) {
            before[k] = texelFetch(VALUES_BEFORE(k), texel, 0);
            usable_all = usable_all && is_usable(before[k], surface);
        }
        if (!usable_all) continue;
        if (by_depth) {
            float plane = max(inverse_depth + dot(slope, vec2(texel) + 0.5 - place), 0.0);
            weight *= exp(-scale * min(relative_distance(surface.x, inverse_depth), relative_distance(surface.x, plane)));
        }
        for (int k = 0; k < TEXTURES; ++k) sum.values[k] += before[k] * weight;
        sum.statistics += surface.yzw * weight;
        sum.acceptance += weight;
    }
    float accepted = max(sum.acceptance, 1.0e-30);
    for (int k = 0; k < TEXTURES; ++k) sum.values[k] /= accepted;
    sum.statistics /= accepted;
    sum.acceptance = total > 0.0 && sum.acceptance > 1.0e-6 ? min(sum.acceptance / total, 1.0) : 0.0;
    return sum;
}

// Of the new frame: no light where it is not a number.
vec4 usable(vec4 v) {
    return all(lessThanEqual(abs(v), vec4(HALF_MAX))) ? max(v, vec4(0.0)) : vec4(0.0, 0.0, 0.0, 1.0);
}

#if CLIP
// What is kept, within 2.5 standard deviations of the mean of the 3x3 pixels of the new frame around, or `least_width`; the
// pixel's own value is always within. Fewer cut off light that few samples find, and a still picture darkens.
vec4 clipped(vec4 kept, int k, vec4 now, ivec2 pixel, ivec2 size, float least_width) {
    count_work(WORK_TEXTURE_FETCHES, 9u);
    vec4 sum = vec4(0.0), squares = vec4(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 texel = clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1);
        vec4 v = usable(texelFetch(VALUES_NOW(k), texel, 0)) - now;
        sum += v;
        squares += v * v;
    }
    sum /= 9.0;
    vec4 width = max(2.5 * sqrt(max(squares / 9.0 - sum * sum, vec4(0.0))), vec4(vec3(least_width), 0.0));
    return clamp(kept, now + min(sum - width, vec4(0.0)), now + max(sum + width, vec4(0.0)));
}
#endif

#if REJECT
// Did the light change? The means of 5x5 pixels of new frame and history differ by d: noise, of a standard deviation sigma that
// is learnt from frame to frame, and what the history does not know yet. A change is
// - one d of more than 2.2 to 3.5 sigma: a lamp went out;
// - a mean of the last d, a geometric one over 4 frames, of more than as many of its own standard deviations (0.38 sigma,
//   and what the history's noise adds): a shadow that wanders;
// - a transmittance that differs by 10 to 30%.
// sigma is at least 2% of the light, and what the new frame's pixels differ by: one bright one is noise. It is learnt over 8 frames, by at most twice itself a frame, lest it learns a change by
// heart; with the change it is 20% of the light at least, for the noise of the new light is not known.
// agreement: 1 no change, 0 a change.
struct Change {
    float agreement, deviation, drift;
};

float luminance(vec4 v) { return dot(v.rgb, vec3(1.0 / 3.0)); }

// Of 5x5 pixels, with the weights (1, 1, 2, 1, 1) / 6 in x and in y; and the variance of its luminance, by that between the
// nine fetches.
vec4 mean_around(sampler2D image, vec2 place, vec2 size, out float variance) {
    count_work(WORK_TEXTURE_FETCHES, 10u);
    vec4 first = textureLod(image, place / size, 0.0);
    vec4 sum = vec4(0.0);
    float squares = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec4 v = textureLod(image, (place + 1.5 * (vec2(i % 3, i / 3) - 1.0)) / size, 0.0) - first;
        sum += v;
        squares += luminance(v) * luminance(v);
    }
    sum /= 9.0;
    variance = max(squares / 9.0 - luminance(sum) * luminance(sum), 0.0) / 8.0;
    return first + sum;
}

Change no_history(float light) { return Change(0.0, 0.2 * light, 0.0); }

Change change_of(vec2 place, Kept kept, vec2 size) {
    float variance_now, variance_before;
    vec4 mean_now = mean_around(VALUES_NOW(0), gl_FragCoord.xy, size, variance_now);
    float now = luminance(mean_now);
    Change start = no_history(min(now, HALF_MAX));
    if (kept.acceptance <= 0.0) return start;
    vec4 mean_before = mean_around(VALUES_BEFORE(0), place, size, variance_before);
    float before = luminance(mean_before);
    float d = now - before;
    float deviation = kept.statistics.y, drift = kept.statistics.z;
    if (!(abs(d) <= HALF_MAX && abs(deviation) <= HALF_MAX && abs(drift) <= HALF_MAX)) return start;
    float noise = 1.0 + 1.0 / max(kept.statistics.x, 1.0);  // variance of d over that of one frame
    float least = 0.02 * max(now, before) + 1.0e-7;
    float variance = max(max(deviation * deviation, variance_now), least * least);
    float off = max(abs(d), abs(drift) / 0.45) / sqrt(variance * noise);
    float t = abs(mean_now.a - mean_before.a) / max(max(mean_now.a, mean_before.a), 0.1);
    float agreement = (1.0 - smoothstep(2.2, 3.5, off)) * (1.0 - smoothstep(0.1, 0.3, t));
    float rest = d - drift;
    float learnt = sqrt(mix(deviation * deviation, min(rest * rest / noise, 4.0 * variance), 0.125));
    return Change(agreement, mix(max(learnt, start.deviation), learnt, agreement), mix(drift, d, 0.25) * agreement);
}
#endif

// One of the two half-precision numbers around v >= 0, the nearer more often: a mean over the frames does not stop where its
// change is less than half a step, and has no bias. r in 0..1.
vec4 dithered_half(vec4 v, float r) {
    v = clamp(v, vec4(0.0), vec4(HALF_MAX));
    ivec4 exponent = max(ivec4(floatBitsToUint(v) >> 23u) - 127, ivec4(-14));
    vec4 quantum = uintBitsToFloat(uvec4(exponent - 10 + 127) << 23u);
    return min(floor(v / quantum + r) * quantum, vec4(HALF_MAX));
}

void main() {
    ivec2 size = textureSize(VALUES_NOW(0), 0);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 surface = surface_of(pixel, size);
    vec4 now[TEXTURES];
    for (int k = 0; k < TEXTURES; ++k) now[k] = usable(texelFetch(VALUES_NOW(k), pixel, 0));
    count_work(WORK_TEXTURE_FETCHES, uint(TEXTURES));

    vec3 place = vec3(gl_FragCoord.xy, 1.0);
    if (taps == 4) place = place_before(surface.x);
    Kept kept = nothing_kept();
    if (taps > 0 && place.z > 0.0) kept = kept_at(place.xy, surface.x * place.z, surface.yz * place.z, size);
    float acceptance = kept.acceptance;
    vec2 statistics = vec2(0.0);

    float least_width = 0.0;
#if REJECT
    Change change = change_of(place.xy, kept, vec2(size));
    acceptance *= change.agreement;
    statistics = vec2(change.deviation, change.drift);
    least_width = 2.0 * change.deviation;
#endif
#if CLIP
    for (int k = 0; k < TEXTURES; ++k)
        kept.values[k] = clipped(kept.values[k], k, now[k], pixel, size, k == 0 ? least_width : 0.0);
#endif

    float frames = min(kept.statistics.x, most_frames - 1.0);
    float known = frames_known(surface.x);
    float kept_frames = min(frames * acceptance, known - 1.0);
    float share = counted ? kept_frames / (kept_frames + 1.0) : min(acceptance * (1.0 - least_weight), 1.0 - 1.0 / known);
    if (acceptance <= 0.0) share = 0.0;
    float most_share = counted ? frames : 1.0 - least_weight;
    out_acceptance = acceptance <= 0.0 ? 0.0 : most_share <= 0.0 ? acceptance : min((counted ? kept_frames : share) / most_share, 1.0);

    float r = (floor(256.0 * golden_ratio_offset(interleaved_gradient_offset(uvec2(pixel), 0u), frame)) + 0.5) / 256.0;
    out_surface = vec4(surface.x, min(kept_frames, 255.0) + 1.0, statistics);
    for (int k = 0; k < TEXTURES; ++k) {
        vec4 past = share > 0.0 ? kept.values[k] : now[k];
        results[k] = dithered_half(past + (now[k] - past) * (1.0 - share), r);
    }
    flush_work();
}
