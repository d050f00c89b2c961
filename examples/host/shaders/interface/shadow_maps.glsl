// Where the sun's rays end, which lets the module follow whole rays instead of asking point by point.
#ifndef INTERFACE_SHADOW_MAPS_GLSL
#define INTERFACE_SHADOW_MAPS_GLSL
#include "shaders/host_frame.glsl"
#include "shaders/shared/lights.h"

const float NO_OCCLUDER = 1.0e9;

// How far before a point, towards the sun, its ray meets the first surface (m; negative: behind the point).
float sun_occluder(vec3 world) {
    vec3 at = (host_world_to_shadow * vec4(world, 1.0)).xyz;
    float first = textureLod(host_shadow_depth, at.xy, 0.0).r;
    return first == 1.0 ? -NO_OCCLUDER : (at.z - first) * host_sun_direction.w;
}
float light_occluder(uint index, GpuLight light, vec3 world) { return -NO_OCCLUDER; }
#endif
