// Averages the visibility of sun and lamps in the froxels over the frames, and adds their light:
//     L = L_diffuse + V_sun L_sun + V_lamps L_lamps,    V_n = V_(n-1) + (v_n - V_(n-1)) / min(n, N).
// Only V is kept, and of the lamps the visible share of the light of all, for each channel: light, media and phase functions
// are this frame's and never lag. V and n are stored in fixed point, which cannot hold NaN. v is sampled at another place of the froxel each frame (froxel_light.comp).
//
// V_(n-1) is that of the froxel's centre where the camera saw it in the frame before. It is forgotten, n = 1,
// - outside that frame's volume and behind what it saw: nothing was stored there;
// - where the samples of the 27 froxels around contradict what these froxels hold. A sample is 1 with the probability V, so
//   their sum differs from the sum of V by a variance of sum V (1 - V) (1 + 1/n); with V estimated as (n V + 1/2) / (n + 1),
//   which is never sure. Four standard deviations and half a sample more are a change. A static scene, whatever its shadows, so
//   is never cut, as it would be by the least and greatest of the neighbours;
// - the lamps' where their unshadowed light changed by more than a factor of 2, the sun's as it turns.
#define CHROMATIC 0
#define HEIGHT_MEDIA 0
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/froxel_grid.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 4) in;

layout(binding = 0) uniform sampler2D farthest_view_depth;
layout(binding = 1) uniform sampler3D visibility_now;  // rgb of the lamps, a of the sun; < 0: nothing to be visible
#if HAS_SUN
layout(binding = 2) uniform sampler3D sun_light;
#endif
#if HAS_LAMPS
layout(binding = 3) uniform sampler3D lamp_light;
#endif
layout(binding = 4) uniform sampler3D visibility_before;
layout(binding = 5) uniform sampler3D certainty_before;
layout(rgba16f, binding = 0) uniform image3D froxel_radiance;
layout(rgba16, binding = 1) writeonly uniform image3D visibility_kept;
layout(rgba16, binding = 2) writeonly uniform image3D certainty_kept;

uniform int history;  // 0: there is none, 1: of another camera, 2: of the same
uniform mat4 previous_clip_from_view;
uniform int previous_distribution;  // of the slices, see froxel_depths.glsl
uniform vec2 previous_depths;
uniform mat4 previous_begins;
uniform mat4 previous_lengths;
uniform vec2 most_frames;  // of the lamps, of the sun

const ivec3 GROUP = ivec3(8, 8, 4);
const ivec3 TILE = GROUP + 2;
const int TILE_SIZE = TILE.x * TILE.y * TILE.z;
const vec4 NOTHING = vec4(-1.0);

shared vec4 samples[TILE_SIZE];   // visibility_now
shared vec4 evidence[TILE_SIZE];  // of lamps, of sun: difference to what is kept, and its variance

// x frames of the lamps, y of the sun, z logarithm of the lamps' unshadowed light.
struct Kept {
    vec4 visibility;
    vec3 certainty;
};

const float MOST = 256.0;       // the largest number of frames that is stored
const float LOG_RANGE = 80.0;  // powers of two about 1

bool is_lit(ivec3 froxel, ivec3 size) {
    if (any(lessThan(froxel, ivec3(0))) || any(greaterThanEqual(froxel, size))) return false;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return froxel.z <= froxel_slice(texelFetch(farthest_view_depth, froxel.xy, 0).r, size.z);
}

Kept unpack(ivec3 froxel) {
    count_work(WORK_TEXTURE_FETCHES, 2u);
    Kept kept;
    kept.visibility = texelFetch(visibility_before, froxel, 0);
    kept.certainty = texelFetch(certainty_before, froxel, 0).xyz * vec3(MOST, MOST, 1.0);
    return kept;
}

// Between the eight froxels around a point, in froxels; without those that hold nothing.
Kept between(vec3 p, ivec3 size) {
    Kept sum = Kept(vec4(0.0), vec3(0.0));
    vec2 total = vec2(0.0);  // of lamps, of sun
    ivec3 base = ivec3(floor(p - 0.5));
    vec3 f = p - 0.5 - vec3(base);
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        vec3 side = mix(1.0 - f, f, vec3(corner));
        float weight = side.x * side.y * side.z;
        ivec3 froxel = base + corner;
        if (weight < 1.0e-4 || any(lessThan(froxel, ivec3(0))) || any(greaterThanEqual(froxel, size))) continue;
        Kept kept = unpack(froxel);
        vec2 holds = weight * step(0.5, kept.certainty.xy);
        sum.visibility += kept.visibility * holds.xxxy;
        sum.certainty += kept.certainty * vec3(weight, weight, holds.x);
        total += holds;
    }
    sum.visibility /= max(total.xxxy, 1.0e-6);
    sum.certainty.z /= max(total.x, 1.0e-6);
    return sum;
}

// The froxel's centre in the frame before, in froxels of that frame: x < 0 where it was not in view.
vec3 place_before(ivec3 froxel, ivec3 size) {
    vec2 uv = (vec2(froxel.xy) + 0.5) / vec2(size.xy);
    vec4 near = volumetrics.inverse_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 p = near.xyz / near.w;
    float view_depth = froxel_view_depth((float(froxel.z) + 0.5) / float(size.z));
    vec4 clip = previous_clip_from_view * vec4(p * (view_depth / -p.z), 1.0);
    if (clip.w <= 0.0 || clip.w > previous_depths.y) return vec3(-2.0);
    float w = previous_distribution == FROXEL_TABLE
                  ? froxel_w_from_table(clip.w, previous_begins, previous_lengths)
                  : froxel_w_from_view_depth(previous_distribution, clip.w, previous_depths.x, previous_depths.y);
    // What is nearer than the slices begin is in the first.
    return vec3(0.5 + 0.5 * clip.xy / clip.w, max(w, 0.5 / float(size.z))) * vec3(size);
}

Kept before(ivec3 froxel, ivec3 size) {
    if (history == 2) return unpack(froxel);
    if (history == 0) return Kept(vec4(0.0), vec3(0.0));
    return between(place_before(froxel, size), size);
}

// What the froxel at that place held.
Kept nearest_before(ivec3 froxel, ivec3 size) {
    if (history == 2) return unpack(froxel);
    ivec3 place = ivec3(floor(place_before(froxel, size)));
    if (any(lessThan(place, ivec3(0))) || any(greaterThanEqual(place, size))) return Kept(vec4(1.0), vec3(0.0));
    return unpack(place);
}

// Of a visibility x against the mean of n frames: difference, and its variance.
vec2 difference(float x, float kept, float n) {
    if (x < 0.0 || n < 0.5) return vec2(0.0);
    float p = (kept * n + 0.5) / (n + 1.0);
    return vec2(x - kept, p * (1.0 - p) * (1.0 + 1.0 / n));
}

vec4 evidence_of(vec4 now, Kept kept) {
    return vec4(difference(mean_channel(now.rgb), mean_channel(kept.visibility.rgb), kept.certainty.x),
                difference(now.a, kept.visibility.a, kept.certainty.y));
}

void load_tile(ivec3 size) {
    ivec3 corner = ivec3(gl_WorkGroupID) * GROUP - 1;
    for (int i = int(gl_LocalInvocationIndex); i < TILE_SIZE; i += GROUP.x * GROUP.y * GROUP.z) {
        ivec3 froxel = corner + ivec3(i % TILE.x, i / TILE.x % TILE.y, i / (TILE.x * TILE.y));
        vec4 now = NOTHING;
        vec4 change = vec4(0.0);
        if (is_lit(froxel, size)) {
            now = texelFetch(visibility_now, froxel, 0);
            count_work(WORK_TEXTURE_FETCHES, 1u);
            if (history != 0) change = evidence_of(now, nearest_before(froxel, size));
        }
        samples[i] = now;
        evidence[i] = change;
    }
}

int in_tile(ivec3 offset) {
    ivec3 p = ivec3(gl_LocalInvocationID) + 1 + offset;
    return p.x + TILE.x * (p.y + TILE.y * p.z);
}

// 1 for the lamps and for the sun where the samples around are what the past leads to expect, 0 where not.
vec2 agreement() {
    vec4 sum = vec4(0.0);
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) sum += evidence[in_tile(ivec3(x, y, z))];
    return step(abs(sum.xz), 4.0 * sqrt(sum.yw) + 0.5);
}

float log_light(vec3 light) {
    return clamp(log2(max(dot(light, vec3(1.0 / 3.0)), 1.0e-12)) / LOG_RANGE + 0.5, 0.0, 1.0);
}

void main() {
    ivec3 size = imageSize(froxel_radiance);
    load_tile(size);
    barrier();
    ivec3 froxel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(froxel, size))) {
        flush_work();
        return;
    }
    vec4 now = samples[in_tile(ivec3(0))];
    if (now == NOTHING) {
        imageStore(visibility_kept, froxel, vec4(1.0));
        imageStore(certainty_kept, froxel, vec4(0.0));
        flush_work();
        return;
    }

    Kept kept = before(froxel, size);
    vec2 frames = kept.certainty.xy * agreement();
    float light_now = 0.0;
#if HAS_LAMPS
    vec3 lamps = texelFetch(lamp_light, froxel, 0).rgb;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    light_now = log_light(lamps);
    frames.x *= 1.0 - smoothstep(0.25, 1.0, LOG_RANGE * abs(light_now - kept.certainty.z));
#endif
    frames = min(frames, most_frames - 1.0);
    // A value that is not a number fails this, too.
    if (!(frames.x >= 0.5)) frames.x = 0.0;
    if (!(frames.y >= 0.5)) frames.y = 0.0;
    vec4 past = mix(now, kept.visibility, step(0.5, frames.xxxy));
    vec4 visibility = past + (now - past) / (frames.xxxy + 1.0);
    frames += 1.0;
    bvec4 nothing = lessThan(now, vec4(0.0));
    visibility = mix(clamp(visibility, 0.0, 1.0), vec4(1.0), nothing);
    if (nothing.r && nothing.g && nothing.b) frames.x = 0.0;
    if (nothing.a) frames.y = 0.0;
    imageStore(visibility_kept, froxel, visibility);
    imageStore(certainty_kept, froxel, vec4(frames / MOST, light_now, 0.0));

    vec3 light = imageLoad(froxel_radiance, froxel).rgb;
#if HAS_SUN
    light += visibility.a * texelFetch(sun_light, froxel, 0).rgb;
    count_work(WORK_TEXTURE_FETCHES, 1u);
#endif
#if HAS_LAMPS
    light += visibility.rgb * lamps;
#endif
    imageStore(froxel_radiance, froxel, round_to_half(vec4(light, 0.0)));
    flush_work();
}
