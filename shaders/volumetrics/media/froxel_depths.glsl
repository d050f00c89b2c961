// The view depths of this frame's froxel slices.
#ifndef VOLUMETRICS_FROXEL_DEPTHS_GLSL
#define VOLUMETRICS_FROXEL_DEPTHS_GLSL

#include "shaders/lib/froxel.glsl"
#include "shaders/volumetrics/frame/data.glsl"

float froxel_far() { return volumetrics.froxel_depths.y; }

// Place in the volume, 0..1, of a view depth, and back, by this frame's distribution.
float froxel_w(float view_depth) {
    int distribution = int(volumetrics.froxel_distribution);
    if (distribution == FROXEL_TABLE)
        return froxel_w_from_table(view_depth, volumetrics.froxel_begins, volumetrics.froxel_lengths);
    return froxel_w_from_view_depth(distribution, view_depth, volumetrics.froxel_depths.x, volumetrics.froxel_depths.y);
}
float froxel_view_depth(float w) {
    int distribution = int(volumetrics.froxel_distribution);
    if (distribution == FROXEL_TABLE)
        return froxel_view_depth_from_table(w, volumetrics.froxel_begins, volumetrics.froxel_lengths);
    return froxel_view_depth_from_w(distribution, w, volumetrics.froxel_depths.x, volumetrics.froxel_depths.y);
}

// View depth where a slice begins; that of slice `count` is the end of the volume.
float froxel_slice_begin(int slice, int count) {
    if (slice <= 0) return 0.0;
    if (slice >= count) return froxel_far();
    return froxel_view_depth(float(slice) / float(count));
}

// The slice at a view depth: the first before the volume, the last behind it.
int froxel_slice(float view_depth, int count) {
    return clamp(int(floor(froxel_w(min(view_depth, froxel_far())) * float(count))), 0, count - 1);
}

#endif
