// CONTRACT: the lights a volumetric technique scatters. A host engine replaces this file; Tyndall's reads its own
// clustered lights. World space, metres, photometric units (shaders/shared/lights.h).
#ifndef INTERFACE_LIGHTS_GLSL
#define INTERFACE_LIGHTS_GLSL

#include "shaders/engine/light_data.glsl"

// Direction sunlight travels (unit) and its illuminance in lux. Called only when the host said there is a sun. Further
// suns are local lights, SUN_LAMP_DISTANCE away, and the first of them.
vec3 sun_direction() { return frame.sun_direction.xyz; }
vec3 sun_illuminance() { return frame.sun_illuminance.rgb; }

// Mean radiance of the ambient light over the sphere of directions.
vec3 ambient_radiance() { return ambient_mean_radiance(); }

// Optional, where Inputs::has_sky_radiance: the ambient light at a point, as shaders/lib/sky_radiance.glsl describes it; then it takes the
// place of ambient_radiance().
#if SKY_VISIBILITY
SkyRadiance ambient_radiance_at(vec3 world) { return sky_radiance_at(world); }
#endif

// The local lights that may reach a point: a range of the list that light_at() indexes. `uv` is the screen position
// (0..1, origin lower left), `view_depth` the distance along the view axis in metres.
ClusterRange lights_near(vec2 uv, float view_depth) { return cluster_at(uv, view_depth); }
// Along a view ray that list changes only between depth slices: the slice at a view depth (>= 0), the view depth where a
// slice ends (at least 1e9 for the last one), and the list in a slice. Without clusters: slice 0 holds all.
// A light must be listed wherever a point within its range (and, for a spot, its cone) lies.
int light_slice(float view_depth) { return cluster_slice(view_depth); }
float light_slice_end(int slice) { return cluster_slice_end(slice); }
ClusterRange lights_in_slice(vec2 uv, int slice) { return cluster_in(uv, slice); }
uint light_index(uint i) { return cluster_lights[i]; }
GpuLight light_at(uint index) { return light_data(index); }

#endif
