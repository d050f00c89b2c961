// CONTRACT, optional: where light ends, for techniques that read whole shadow maps instead of asking for single points. A
// host engine replaces this file and says so (Inputs::has_shadow_maps); it may trace rays instead.
#ifndef INTERFACE_SHADOW_MAPS_GLSL
#define INTERFACE_SHADOW_MAPS_GLSL

#include "shaders/engine/glass_lookup.glsl"
#include "shaders/engine/shadow_occluder.glsl"

// Of the light's ray through a point: distance (m) from the point towards the light at which the ray meets a surface for
// the first time; negative where that is behind the point, -NO_OCCLUDER where it meets none. A point is lit where it is
// <= 0. NO_OCCLUDER: 1e9.
float sun_occluder(vec3 world) { return sun_shadow_occluder(world); }
float light_occluder(uint index, GpuLight light, vec3 world) { return light_shadow_occluder(light, world); }

// Where Inputs::sun_through_glass: whether the sun's ray through a point passes glass before its first surface, wherever on the ray
// the point lies. Where it says so of rays that pass none, time is lost and nothing else.
#if GLASS
bool sun_ray_meets_glass(vec3 world) { return sun_ray_glass(world); }
#endif

#endif
