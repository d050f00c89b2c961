// CONTRACT: visibility of the lights, 0 (dark) to 1 (lit). A host engine replaces this file.
#ifndef INTERFACE_SHADOWS_GLSL
#define INTERFACE_SHADOWS_GLSL

#include "shaders/engine/glass_lookup.glsl"
#include "shaders/engine/shadow_lookup.glsl"

// `view_depth` picks the cascade. One lookup, unfiltered in depth bias: the point is in the air, not on a surface.
float sun_visibility(vec3 world, float view_depth) { return sun_shadow_volume(world, view_depth); }
float light_visibility(uint index, GpuLight light, vec3 world) { return light_shadow_volume(light, world); }

// Optional, where Inputs::sun_through_glass or a lamp's through_glass: what glass leaves of each channel of light that is visible, 0 to 1.
#if GLASS
vec3 sun_filter(vec3 world, float view_depth) { return sun_glass(world, view_depth); }
vec3 light_filter(uint index, GpuLight light, vec3 world) { return light_glass(light, world); }
#endif

#endif
