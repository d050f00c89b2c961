// The lamps that survive culling, as light_cull writes and cluster reads them.
#ifndef ENGINE_VISIBLE_LIGHTS_H
#define ENGINE_VISIBLE_LIGHTS_H
#include "shaders/shared/types.h"

SHARED_BEGIN

struct VisibleLightsHeader {
    uint count;      // lamps that follow, in the order of the light list
    uint pool_used;  // entries of the cluster light list that cluster has handed out
    uint occluded;   // lamps in the frustum that the depth pyramid hid
    uint unused;
};

struct VisibleLight {
    vec4 sphere;      // view space: centre (m), radius of what the lamp reaches
    vec4 apex_range;  // view space: position (m), range
    vec4 axis_cosine; // view space: unit axis, cosine of the outer half angle; -1 for a point lamp
    uvec4 index_box;  // x light index; first and last cluster as lo | hi << 16 in y, z, w for x, y and slice
};

SHARED_END
#endif
