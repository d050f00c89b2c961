// What noise makes of the local media, summed up along each column of froxels: r int sum_i sigma_i density_i noise_i dt from
// the eye to the end of a slice, over the media that have noise; g the same without noise. Layer 0 is the eye, layer k the end
// of slice k - 1. The difference of two places of a column, r over g, is the mean noise between them, for any length: a march
// of few steps and one of many see the same medium. sigma is the mean sigma_t, which tells how much a medium counts.
#include "shaders/volumetrics/media/ray_media.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D farthest_view_depth;
layout(rg32f, binding = 0) writeonly uniform image3D sums;

const int MOST_SAMPLES = 8;  // of a medium in a slice

void add_medium(uint index, Ray ray, float begin, float end, inout vec2 sum) {
    LocalMedium medium = local_media[index];
    if (!has_noise(medium)) return;
    vec2 part = inside_shape(medium, ray.origin, ray.direction, begin, end);
    if (part.x >= part.y) return;
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    float depth = (part.y - part.x) * mean_density(medium, ray.origin, ray.direction, part.x, part.y) *
                  (mean_channel(local_sigma_t(medium)) + 1.0e-6);
    sum += depth * vec2(mean_noise(medium, ray.origin, ray.direction, part.x, part.y, MOST_SAMPLES), 1.0);
}

bool meets_noise() {
    bool noise = chords_left < volumetrics.local_media_count;
    for (int i = 0; i < chord_count; ++i) noise = noise || has_noise(local_media[chord_medium[i]]);
    return noise;
}

// What is lit has as many columns or fewer: of those that meet this one.
float farthest_through(ivec2 column, ivec2 columns) {
    ivec2 lit = textureSize(farthest_view_depth, 0);
    ivec2 low = column * lit / columns;
    ivec2 high = ((column + 1) * lit - 1) / columns;
    float farthest = 0.0;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            count_work(WORK_TEXTURE_FETCHES, 1u);
            farthest = max(farthest, texelFetch(farthest_view_depth, ivec2(x, y), 0).r);
        }
    return farthest;
}

void main() {
    ivec3 size = imageSize(sums);
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) return;
    Ray ray = view_ray((vec2(column) + 0.5) / vec2(size.xy));
    // Pixels beside the column may see a little farther than it.
    float seen = 1.05 * farthest_through(column, size.xy) / ray.forward_cosine;
    find_chords(ray, 0.0, seen, false);
    if (!meets_noise()) {  // the volume was cleared before
        flush_work();
        return;
    }
    vec2 sum = vec2(0.0);
    float begin = 0.0;
    for (int slice = 0; slice + 1 < size.z; ++slice) {
        float end = froxel_slice_begin(slice + 1, size.z - 1) / ray.forward_cosine;
        if (begin < media_span.y && end > media_span.x) {
            for (int i = 0; i < chord_count; ++i)
                if (chord_span[i].x < min(end, seen) && chord_span[i].y > begin)
                    add_medium(chord_medium[i], ray, begin, min(end, seen), sum);
            for (uint i = chords_left; i < volumetrics.local_media_count; ++i)
                add_medium(i, ray, begin, min(end, seen), sum);
        }
        imageStore(sums, ivec3(column, slice + 1), vec4(sum, 0.0, 0.0));
        begin = end;
    }
    flush_work();
}
