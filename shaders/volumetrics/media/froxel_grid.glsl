// The froxel volume along a view ray. A column is a ray through the middle of a froxel of the screen's plane; it is cut
// into `count` slices by view depth. Slice 0 begins at the eye, wherever the distribution does.
#ifndef VOLUMETRICS_FROXEL_GRID_GLSL
#define VOLUMETRICS_FROXEL_GRID_GLSL

#include "shaders/volumetrics/media/extinction.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/media/global_media.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

// Optical depth of the global media between two distances along a ray.
Extinction global_optical_depth(Ray ray, float begin, float end) {
    float path_length = end - begin;
    return to_extinction(min(volumetrics.homogeneous_sigma_t.rgb * path_length +
                                 height_optical_depth(ray.origin.y + ray.direction.y * begin, ray.direction.y,
                                                      path_length),
                             MAX_OPTICAL_DEPTH));
}

// Of the light that a segment sends to its front, the share that its first part sends, given the optical depths of both:
// (1 - exp(-part)) / (1 - exp(-whole)). Exact where the source is everywhere in proportion to the extinction. Without
// extinction it is the share of the length.
Extinction gathered_share(Extinction part, Extinction whole, float length_share) {
    Extinction of_part = part * mean_transmittance(part, exp(-part));
    Extinction of_whole = whole * mean_transmittance(whole, exp(-whole));
    Extinction share = clamp(of_part / max(of_whole, 1.0e-20), 0.0, 1.0);
    return mix(Extinction(length_share), share, step(1.0e-20, of_whole));
}

#endif
