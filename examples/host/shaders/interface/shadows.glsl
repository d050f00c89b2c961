// The shadows of this host, as the module asks for them. Points lie in the air: one lookup, without a bias.
#ifndef INTERFACE_SHADOWS_GLSL
#define INTERFACE_SHADOWS_GLSL
#include "shaders/host_frame.glsl"
#include "shaders/shared/lights.h"

float sun_visibility(vec3 world, float view_depth) { return host_sun_visibility(world, vec2(0.0)); }
float light_visibility(uint index, GpuLight light, vec3 world) { return 1.0; }
#endif
