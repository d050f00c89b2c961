// Cuts each column of froxels into runs of slices in which the local media hardly change, so that a march reads them
// once a run. Of a run with values from low to high over a length L it reads one of them: an error of at most
// (high - low) L, which is kept below TOLERANCE of the column's whole sum. What they leave of the sun hardly changes over
// a run either: the march takes its optical depth to be linear.
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/light/light_transmittance.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D farthest_view_depth;
layout(binding = 1) uniform sampler3D froxel_scattering;
layout(binding = 2) uniform sampler3D froxel_extinction;
#if EMISSION
layout(binding = 3) uniform sampler3D froxel_emission;
#endif
// Word i of column x, y at (x * words + i, y), for 32 slices: x a bit where a run begins, y where there is a local medium.
layout(rg32ui, binding = 0) writeonly uniform uimage2D froxel_runs;
uniform ivec2 live_slices;  // the first that may hold a local medium, and behind the last

const float TOLERANCE = 1.0 / 256.0;
const float SUN_TOLERANCE = 0.05;
const float SUN_DARK = 8.0;

struct Sample {
    vec4 scattering;
    vec3 emission;
    float extinction;
    float sun;  // optical depth of local media towards it
};
const Sample NOTHING = Sample(vec4(0.0), vec3(0.0), 0.0, 0.0);

Sample sample_at(ivec3 froxel) {
    Sample s = NOTHING;
    s.extinction = texelFetch(froxel_extinction, froxel, 0).r;  // alike in all channels: see reason_for_no_parts
    count_work(WORK_TEXTURE_FETCHES, 1u);
    if (s.extinction > 0.0) {
        s.scattering = texelFetch(froxel_scattering, froxel, 0);
        count_work(WORK_TEXTURE_FETCHES, 1u);
    }
#if EMISSION
    s.emission = texelFetch(froxel_emission, froxel, 0).rgb;
    count_work(WORK_TEXTURE_FETCHES, 1u);
#endif
    return s;
}

bool holds_medium(Sample s) { return s.extinction > 0.0 || any(greaterThan(s.emission, vec3(0.0))); }

// Whether a run from `low` to `high` over a length deviates by no more than `most`.
bool is_even(Sample low, Sample high, float path_length, Sample most) {
    return all(lessThanEqual((high.scattering - low.scattering) * path_length, most.scattering)) &&
           all(lessThanEqual((high.emission - low.emission) * path_length, most.emission)) &&
           (high.extinction - low.extinction) * path_length <= most.extinction &&
           high.sun - low.sun <= SUN_TOLERANCE;
}

Sample smaller(Sample a, Sample b) {
    return Sample(min(a.scattering, b.scattering), min(a.emission, b.emission), min(a.extinction, b.extinction),
                  min(a.sun, b.sun));
}
Sample larger(Sample a, Sample b) {
    return Sample(max(a.scattering, b.scattering), max(a.emission, b.emission), max(a.extinction, b.extinction),
                  max(a.sun, b.sun));
}

// TOLERANCE of the column's sums over its view depths, from a slice of every few.
Sample column_tolerance(ivec2 column, int end, int count) {
    const int STRIDE = 4;
    Sample most = NOTHING;
    for (int slice = live_slices.x; slice < end; slice += STRIDE) {
        int behind = min(slice + STRIDE, end);
        float share = TOLERANCE * (froxel_slice_begin(behind, count) - froxel_slice_begin(slice, count));
        Sample s = sample_at(ivec3(column, (slice + behind) / 2));
        most.scattering += share * abs(s.scattering);
        most.emission += share * s.emission;
        most.extinction += share * s.extinction;
    }
    return most;
}

// Behind the last slice of the column and those around it that somebody sees, and one more: see inject_media.comp.
int column_end(ivec2 column, ivec3 size) {
    float farthest = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 around = clamp(column + ivec2(i % 3, i / 3) - 1, ivec2(0), size.xy - 1);
        farthest = max(farthest, texelFetch(farthest_view_depth, around, 0).r);
    }
    count_work(WORK_TEXTURE_FETCHES, 9u);
    return min(size.z, froxel_slice(farthest, size.z) + 3);
}

void main() {
    ivec3 size = textureSize(froxel_extinction, 0);
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) return;
    int words = (size.z + 31) / 32;
    int seen_end = column_end(column, size);
    int live_end = min(seen_end, live_slices.y);
    int changes_begin = LIGHT_VOLUMES != 0 ? 0 : live_slices.x;
    int changes_end = LIGHT_VOLUMES != 0 ? seen_end : min(live_end + 1, size.z);
    Ray ray = view_ray((vec2(column) + 0.5) / vec2(size.xy));
    Sample most = column_tolerance(column, live_end, size.z);
    Sample low = NOTHING;
    Sample high = NOTHING;
    float run_begin = 0.0;
    for (int word = 0; word < words; ++word) {
        uvec2 bits = uvec2(0u);
        int end = min(32 * word + 32, changes_end);
        for (int slice = max(32 * word, changes_begin); slice < end; ++slice) {
            Sample s = NOTHING;
            if (slice >= live_slices.x && slice < live_end) s = sample_at(ivec3(column, slice));
#if LIGHT_VOLUMES
            float view_depth = froxel_view_depth((float(slice) + 0.5) / float(size.z));
            vec3 point = ray.origin + ray.direction * (view_depth / ray.forward_cosine);
            s.sun = min(mean_channel(local_sun_optical_depth(point)), SUN_DARK);
#endif
            uint bit = 1u << uint(slice - 32 * word);
            if (holds_medium(s)) bits.y |= bit;
            low = smaller(low, s);
            high = larger(high, s);
            if (slice > 0 && is_even(low, high, froxel_slice_begin(slice + 1, size.z) - run_begin, most)) continue;
            bits.x |= bit;
            low = s;
            high = s;
            run_begin = froxel_slice_begin(slice, size.z);
        }
        imageStore(froxel_runs, ivec2(column.x * words + word, column.y), uvec4(bits, 0u, 0u));
    }
    flush_work();
}
