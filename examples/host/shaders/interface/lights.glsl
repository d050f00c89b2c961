// The lights of this host, as the module asks for them: a sun, and one lamp that is in every list.
#ifndef INTERFACE_LIGHTS_GLSL
#define INTERFACE_LIGHTS_GLSL
#include "shaders/shared/lights.h"
#include "shaders/host_frame.glsl"

vec3 sun_direction() { return host_sun_direction.xyz; }
vec3 sun_illuminance() { return host_sun_illuminance.rgb; }
vec3 ambient_radiance() { return host_ambient.rgb; }

int light_slice(float view_depth) { return 0; }
float light_slice_end(int slice) { return 1.0e9; }
ClusterRange lights_in_slice(vec2 uv, int slice) { return ClusterRange(0u, 1u); }
ClusterRange lights_near(vec2 uv, float view_depth) { return ClusterRange(0u, 1u); }
uint light_index(uint i) { return i; }
GpuLight light_at(uint index) {
    const vec4 point_lamp = vec4(0.0, -1.0, 0.0, LIGHT_POINT), casts_no_shadow = vec4(0.0, 1.0, -1.0, 0.0);
    return GpuLight(host_lamp_position, host_lamp_intensity, point_lamp, casts_no_shadow);
}
#endif
