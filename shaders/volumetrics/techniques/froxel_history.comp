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
//
// A group walks along its columns, so that of the 27 froxels only the nine of the slice in front are new; it ends at the
// farthest surface. HISTORY: 0 there is none, 1 of another camera, 2 of the same.
#define CHROMATIC 0
#define HEIGHT_MEDIA 0
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/media/froxel_grid.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

layout(binding = 0) uniform sampler2D farthest_view_depth;
layout(binding = 1) uniform sampler3D visibility_now;  // rgb of the lamps, a of the sun; < 0: nothing to be visible
#if HAS_SUN
layout(binding = 2) uniform sampler3D sun_light;
#endif
#if HAS_LAMPS
layout(binding = 3) uniform sampler3D lamp_light;
#endif
#if HISTORY
layout(binding = 4) uniform sampler3D visibility_before;
layout(binding = 5) uniform sampler3D certainty_before;
#endif
layout(rgba16f, binding = 0) uniform image3D froxel_radiance;
layout(rgba16, binding = 1) writeonly uniform image3D visibility_kept;
layout(rgba16, binding = 2) writeonly uniform image3D certainty_kept;

#if HISTORY == 1
uniform mat4 previous_clip_from_view;
uniform int previous_distribution;  // of the slices, see froxel_depths.glsl
uniform vec2 previous_depths;
uniform mat4 previous_begins;
uniform mat4 previous_lengths;
#endif
uniform vec2 most_frames;  // of the lamps, of the sun

const int RUN = 16;  // slices that a group walks along
const ivec2 GROUP = ivec2(16);

const vec4 NOTHING = vec4(-1.0);
const float MOST = 256.0;      // the largest number of frames that is stored
const float LOG_RANGE = 80.0;  // powers of two about 1

// x frames of the lamps, y of the sun, z logarithm of the lamps' unshadowed light.
struct Kept {
    vec4 visibility;
    vec3 certainty;
};

struct Column {
    ivec2 place;
    int last;  // its last slice that is lit, -1 outside the volume
#if HISTORY == 1
    vec4 clip;  // of the frame before: what one metre of view depth adds to it
#endif
};

Column column_at(ivec2 place, ivec3 size) {
    Column column;
    column.place = place;
    column.last = -1;
    if (all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, size.xy))) {
        column.last = froxel_slice(texelFetch(farthest_view_depth, place, 0).r, size.z);
        count_work(WORK_TEXTURE_FETCHES, 1u);
    }
#if HISTORY == 1
    vec2 uv = (vec2(place) + 0.5) / vec2(size.xy);
    vec4 near = volumetrics.inverse_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    column.clip = previous_clip_from_view * vec4(near.xyz / -near.z, 0.0);
#endif
    return column;
}

vec4 sample_now(ivec3 froxel) {
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return texelFetch(visibility_now, froxel, 0);
}

float log_light(vec3 light) {
    return clamp(log2(max(dot(light, vec3(1.0 / 3.0)), 1.0e-12)) / LOG_RANGE + 0.5, 0.0, 1.0);
}

// Keeps the mean of a froxel and adds its light. `agrees`: 1 for the lamps, for the sun, where the past still holds.
void add_frame(ivec3 froxel, vec4 now, Kept kept, vec2 agrees) {
    vec2 frames = kept.certainty.xy * agrees;
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
}

#if HISTORY
Kept unpack(ivec3 froxel) {
    count_work(WORK_TEXTURE_FETCHES, 2u);
    Kept kept;
    kept.visibility = texelFetch(visibility_before, froxel, 0);
    kept.certainty = texelFetch(certainty_before, froxel, 0).xyz * vec3(MOST, MOST, 1.0);
    return kept;
}

#if HISTORY == 1
// The middle of a froxel in the frame before, in froxels of that frame: x < 0 where it was not in view.
vec3 place_before(Column column, int slice, ivec3 size) {
    float view_depth = froxel_view_depth((float(slice) + 0.5) / float(size.z));
    vec4 clip = previous_clip_from_view[3] + view_depth * column.clip;
    if (clip.w <= 0.0 || clip.w > previous_depths.y) return vec3(-2.0);
    float w = previous_distribution == FROXEL_TABLE
                  ? froxel_w_from_table(clip.w, previous_begins, previous_lengths)
                  : froxel_w_from_view_depth(previous_distribution, clip.w, previous_depths.x, previous_depths.y);
    // What is nearer than the slices begin is in the first.
    return vec3(0.5 + 0.5 * clip.xy / clip.w, max(w, 0.5 / float(size.z))) * vec3(size);
}

#endif

struct Past {
    Kept here;     // between the eight froxels around the place
    Kept nearest;  // what the froxel at the place held
};

// Of the middle of a froxel.
Past past_of(Column column, int slice, ivec3 size) {
    const Kept nothing = Kept(vec4(1.0), vec3(0.0));
    Past past = Past(nothing, nothing);
#if HISTORY == 1
    vec3 p = place_before(column, slice, size) - 0.5;
    ivec3 base = ivec3(floor(p));
    vec3 f = p - vec3(base);
    Kept sum = Kept(vec4(0.0), vec3(0.0));
    vec2 total = vec2(0.0);  // of lamps, of sun
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        vec3 side = mix(1.0 - f, f, vec3(corner));
        float weight = side.x * side.y * side.z;
        ivec3 froxel = base + corner;
        if (weight < 1.0e-4 || any(lessThan(froxel, ivec3(0))) || any(greaterThanEqual(froxel, size))) continue;
        Kept kept = unpack(froxel);
        if (corner == ivec3(step(0.5, f))) past.nearest = kept;
        vec2 holds = weight * step(0.5, kept.certainty.xy);
        sum.visibility += kept.visibility * holds.xxxy;
        sum.certainty += kept.certainty * vec3(weight, weight, holds.x);
        total += holds;
    }
    sum.visibility /= max(total.xxxy, 1.0e-6);
    sum.certainty.z /= max(total.x, 1.0e-6);
    past.here = sum;
#else
    past.here = past.nearest = unpack(ivec3(column.place, slice));
#endif
    return past;
}

// That of the froxel at the place alone.
Kept nearest_before(Column column, int slice, ivec3 size) {
#if HISTORY == 1
    ivec3 place = ivec3(floor(place_before(column, slice, size)));
    if (any(lessThan(place, ivec3(0))) || any(greaterThanEqual(place, size))) return Kept(vec4(1.0), vec3(0.0));
    return unpack(place);
#else
    return unpack(ivec3(column.place, slice));
#endif
}

// Evidence of a change, of the lamps and of the sun: what the samples differ by from what is kept, in the upper half of a
// word in units of 1 / 1024, and its variance, in the lower half in units of 1 / 4096. The sum of 27 still fits.
const ivec2 TILE = GROUP + 2;
shared ivec2 evidence[2][TILE.x * TILE.y];  // of slices even and odd: a barrier a slice is enough

int difference(float x, float kept, float n) {
    float p = (kept * n + 0.5) / (n + 1.0);
    float variance = min(p * (1.0 - p) * (1.0 + 1.0 / n), 0.5);
    int word = int(roundEven(1024.0 * clamp(x - kept, -1.0, 1.0))) * 65536 + int(4096.0 * variance + 0.5);
    return x < 0.0 || n < 0.5 ? 0 : word;
}

ivec2 evidence_of(vec4 now, Kept kept) {
    return ivec2(difference(mean_channel(now.rgb), mean_channel(kept.visibility.rgb), kept.certainty.x),
                 difference(now.a, kept.visibility.a, kept.certainty.y));
}

vec2 agreement(ivec2 sum) {
    vec2 difference = vec2(sum >> 16) / 1024.0;
    vec2 variance = vec2(sum & 0xffff) / 4096.0;
    return step(abs(difference), 4.0 * sqrt(variance) + 0.5);
}

int tile_index(ivec2 place) { return place.x + TILE.x * place.y; }

// Over the nine froxels of a slice around a place in the tile.
ivec2 sum_of_slice(int slice, ivec2 in_tile) {
    ivec2 sum = ivec2(0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) sum += evidence[slice & 1][tile_index(in_tile + ivec2(x, y))];
    return sum;
}

// The froxels of the tile around those of the group: how many, and the place of each.
const int BORDER = 2 * (TILE.x + GROUP.y);
ivec2 border_place(int i) {
    if (i < 2 * TILE.x) return ivec2(i % TILE.x, i < TILE.x ? 0 : TILE.y - 1);
    i -= 2 * TILE.x;
    return ivec2(i < GROUP.y ? 0 : TILE.x - 1, 1 + i % GROUP.y);
}

shared int last_of_group;

void add_frames(Column column, int begin, int end, ivec3 size) {
    int index = int(gl_LocalInvocationIndex);
    if (index == 0) last_of_group = -1;
    barrier();
    atomicMax(last_of_group, min(column.last, end - 1));
    barrier();
    int last = last_of_group;
    if (last < begin) return;

    ivec2 in_tile = ivec2(gl_LocalInvocationID.xy) + 1;
    ivec2 border_in_tile = border_place(min(index, BORDER - 1));
    Column border = column_at(ivec2(gl_WorkGroupID.xy) * GROUP + border_in_tile - 1, size);

    // Of the slice behind that of the barrier, whose 27 froxels are then complete; `sums` of it and of the one behind it.
    vec4 now = NOTHING;
    Kept kept = Kept(vec4(1.0), vec3(0.0));
    ivec2 sum = ivec2(0), sums = ivec2(0);
    for (int z = begin - 1; z <= last + 1; ++z) {
        vec4 next_now = NOTHING;
        Past past = Past(kept, kept);
        ivec2 change = ivec2(0);
        if (z >= 0 && z <= column.last) {
            next_now = sample_now(ivec3(column.place, z));
            past = past_of(column, z, size);
            change = evidence_of(next_now, past.nearest);
        }
        evidence[z & 1][tile_index(in_tile)] = change;
        for (int i = index; i < BORDER; i += GROUP.x * GROUP.y) {  // at most once
            ivec2 beside = ivec2(0);
            if (z >= 0 && z <= border.last)
                beside = evidence_of(sample_now(ivec3(border.place, z)), nearest_before(border, z, size));
            evidence[z & 1][tile_index(border_in_tile)] = beside;
        }
        barrier();
        ivec2 next_sum = sum_of_slice(z, in_tile);
        if (z > begin && z - 1 <= column.last)
            add_frame(ivec3(column.place, z - 1), now, kept, agreement(sums + next_sum));
        now = next_now;
        kept = past.here;
        sums = sum + next_sum;
        sum = next_sum;
    }
}
#else
void add_frames(Column column, int begin, int end, ivec3 size) {
    for (int z = begin; z <= min(column.last, end - 1); ++z) {
        ivec3 froxel = ivec3(column.place, z);
        add_frame(froxel, sample_now(froxel), Kept(vec4(0.0), vec3(0.0)), vec2(0.0));
    }
}
#endif

void main() {
    ivec3 size = imageSize(froxel_radiance);
    int begin = RUN * int(gl_WorkGroupID.z);
    int end = min(begin + RUN, size.z);
    Column column = column_at(ivec2(gl_GlobalInvocationID.xy), size);
    add_frames(column, begin, end, size);
    if (any(greaterThanEqual(column.place, size.xy))) end = begin;
    for (int z = max(begin, column.last + 1); z < end; ++z)
        imageStore(certainty_kept, ivec3(column.place, z), vec4(0.0));
    flush_work();
}
