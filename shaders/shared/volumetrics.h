// The volumetrics module's uniform block and local media.
#ifndef SHARED_VOLUMETRICS_H
#define SHARED_VOLUMETRICS_H
#include "shaders/shared/types.h"

#define MAX_HEIGHT_MEDIA 4

#define SHAPE_ELLIPSOID 0
#define SHAPE_BOX 1

SHARED_BEGIN

struct HeightMedium {
    vec4 sigma_s_base;     // rgb 1/m at density 1, w base (m)
    vec4 sigma_t_falloff;  // rgb 1/m at density 1, w falloff (m)
    vec4 emission_g;       // rgb radiance per metre at density 1, w anisotropy
};

struct LocalMedium {
    mat4 world_to_shape;   // world to the shape's centre frame in metres (rotation and translation only)
    vec4 extent_softness;  // xyz half extents or radii (m), w softness (m)
    vec4 sigma_s_g;        // rgb 1/m at density 1, w anisotropy
    vec4 sigma_a_shape;    // rgb 1/m at density 1, w SHAPE_*
    vec4 emission_noise;   // rgb radiance per metre at density 1, w noise amount 0..1
    vec4 noise_height;     // x noise scale (m), y seed, z base (m), w falloff (m); falloff 0 = no height profile
    vec4 bounds_min;       // xyz world box
    vec4 bounds_max;
};

struct VolumetricsData {
    mat4 view;
    mat4 inverse_view_projection;
    mat4 inverse_projection;
    mat4 inverse_view;
    vec4 eye;               // xyz world, w near (m)
    vec4 viewport;          // width, height, 1/width, 1/height of the march target, px
    vec4 homogeneous_sigma_s;  // rgb 1/m, w anisotropy (weighted by scattering over the homogeneous media)
    vec4 homogeneous_sigma_t;  // rgb 1/m
    vec4 homogeneous_emission; // rgb radiance per metre
    uvec4 counts;           // x height media, y local media, z steps, w frame index
    vec4 froxel_size;       // xyz grid, w far distance (m, view depth)
    vec4 march;             // x max distance (m), y exponential stepping strength, z dither size, w unused
    HeightMedium height[MAX_HEIGHT_MEDIA];
};

SHARED_END
#endif
