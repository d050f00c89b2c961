// A walk along a view ray over the runs of froxel slices that froxel_runs.comp found.
#ifndef VOLUMETRICS_FROXEL_RUNS_GLSL
#define VOLUMETRICS_FROXEL_RUNS_GLSL

#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

struct FroxelRun {
    int begin;  // slices
    int end;
    float distance_end;  // m along the ray
    bool in_media;
    int count;  // of all slices
    int word;
    uvec2 bits;  // of that word
};

FroxelRun froxel_run_before(int count) { return FroxelRun(0, 0, 0.0, false, count, -1, uvec2(0u)); }

// Runs of the four columns that linear filtering reads: what is even in each is even.
uvec2 froxel_run_bits(usampler2D runs, Ray ray, int word, int words) {
    ivec2 last = textureSize(runs, 0) / ivec2(words, 1) - 1;
    ivec2 corner = ivec2(floor(ray.uv * vec2(last + 1) - 0.5));
    uvec2 bits = uvec2(0u);
    for (int i = 0; i < 4; ++i) {
        ivec2 column = clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), last);
        bits |= texelFetch(runs, ivec2(column.x * words + word, column.y), 0).rg;
    }
    count_work(WORK_TEXTURE_FETCHES, 4u);
    return bits;
}

// The run behind this one. The last one lies behind the froxels and has no end.
void next_froxel_run(usampler2D runs, Ray ray, inout FroxelRun run) {
    const float NO_END = 1.0e30;
    run.begin = run.end;
    if (run.begin >= run.count) {
        run.in_media = false;
        run.distance_end = NO_END;
        return;
    }
    int word = run.begin / 32;
    if (word != run.word) {
        run.word = word;
        run.bits = froxel_run_bits(runs, ray, word, (run.count + 31) / 32);
    }
    uint first = uint(run.begin - 32 * word);
    uint later = run.bits.x & (~1u << first);
    int end = later == 0u ? 32 : findLSB(later);
    run.end = min(32 * word + end, run.count);
    run.in_media = (run.bits.y & (~0u << first) & (~0u >> uint(32 - end))) != 0u;
    run.distance_end = froxel_slice_begin(run.end, run.count) / ray.forward_cosine;
}

// Place in the volume of a view depth in the run, at which filtering reads slices of the run alone.
float froxel_run_w(FroxelRun run, float view_depth) {
    float slice = froxel_w(view_depth) * float(run.count);
    return clamp(slice, float(run.begin) + 0.5, float(run.end) - 0.5) / float(run.count);
}

#endif
