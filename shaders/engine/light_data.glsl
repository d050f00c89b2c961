// The engine's frame block, light list and clusters, as shaders read them.
#ifndef ENGINE_LIGHT_DATA_GLSL
#define ENGINE_LIGHT_DATA_GLSL

#include "shaders/shared/bindings.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/lights.h"

layout(std140, binding = BINDING_FRAME) uniform FrameBlock { FrameData frame; };
layout(std430, binding = BINDING_LIGHTS) readonly buffer LightBuffer { GpuLight lights[]; };
layout(std430, binding = BINDING_CLUSTERS) readonly buffer ClusterBuffer { ClusterRange clusters[]; };
layout(std430, binding = BINDING_CLUSTER_LIGHTS) readonly buffer ClusterLightBuffer { uint cluster_lights[]; };
layout(binding = UNIT_AMBIENT) uniform samplerCube ambient_cube;  // irradiance / pi per direction, mipped to 1x1

// Slices are logarithmic in view depth; slice 0 also holds everything nearer than the cluster near plane.
ClusterRange cluster_at(vec2 uv, float view_depth) {
    uvec3 size = frame.cluster_size.xyz;
    float slice = log(max(view_depth, frame.depth.y) / frame.depth.y) * frame.depth.w;
    if (slice >= float(size.z)) return ClusterRange(0u, 0u);
    uvec3 c = min(uvec3(clamp(uv, 0.0, 1.0) * vec2(size.xy), uint(slice)), size - 1u);
    return clusters[c.x + size.x * (c.y + size.y * c.z)];
}

// Mean radiance over all directions: the mean of irradiance / pi over the sphere is the mean of the radiance, and the
// last mip holds one texel a face.
vec3 ambient_mean_radiance() {
    vec3 sum = vec3(0.0);
    for (int face = 0; face < 6; ++face) {
        vec3 axis = vec3(0.0);
        axis[face >> 1] = (face & 1) == 0 ? 1.0 : -1.0;
        sum += textureLod(ambient_cube, axis, 16.0).rgb;
    }
    return sum * (frame.exposure.y / 6.0);
}

#endif
