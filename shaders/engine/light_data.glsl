// The engine's frame block, light list and clusters, as shaders read them.
#ifndef ENGINE_LIGHT_DATA_GLSL
#define ENGINE_LIGHT_DATA_GLSL

#include "shaders/engine/frame_block.glsl"
#include "shaders/engine/sky_volume.glsl"
#include "shaders/shared/lights.h"

layout(rgba32f, binding = IMAGE_LIGHTS) readonly uniform imageBuffer light_texels;
layout(std430, binding = BINDING_CLUSTERS) readonly buffer ClusterBuffer { ClusterRange clusters[]; };
layout(std430, binding = BINDING_CLUSTER_LIGHTS) readonly buffer ClusterLightBuffer { uint cluster_lights[]; };
#if !SKY_VISIBILITY
layout(binding = UNIT_AMBIENT) uniform samplerCube ambient_cube;  // irradiance / pi per direction, mipped to 1x1
#endif

GpuLight light_data(uint index) {
    int i = 4 * int(index);
    return GpuLight(imageLoad(light_texels, i), imageLoad(light_texels, i + 1), imageLoad(light_texels, i + 2),
                    imageLoad(light_texels, i + 3));
}

// Slices are logarithmic in view depth. Slice 0 also holds everything nearer than the cluster near plane, the last one
// everything farther than the far plane.
int cluster_slice(float view_depth) {
    float slice = log(max(view_depth, frame.depth.y) / frame.depth.y) * frame.depth.w;
    return int(min(slice, float(frame.cluster_size.z) - 0.5));
}

float cluster_slice_end(int slice) {
    if (slice + 1 >= int(frame.cluster_size.z)) return 1.0e9;
    return frame.depth.y * exp(float(slice + 1) / frame.depth.w);
}

ClusterRange cluster_in(vec2 uv, int slice) {
    uvec3 size = frame.cluster_size.xyz;
    uvec3 c = min(uvec3(clamp(uv, 0.0, 1.0) * vec2(size.xy), uint(slice)), size - 1u);
    return clusters[c.x + size.x * (c.y + size.y * c.z)];
}

ClusterRange cluster_at(vec2 uv, float view_depth) { return cluster_in(uv, cluster_slice(view_depth)); }

// Mean radiance of the open sky over all directions: the mean of irradiance / pi over the sphere is the mean of the radiance, and the
// last mip holds one texel a face.
vec3 ambient_mean_radiance() {
#if SKY_VISIBILITY
    return sky_radiance_open().mean;
#else
    vec3 sum = vec3(0.0);
    for (int face = 0; face < 6; ++face) {
        vec3 axis = vec3(0.0);
        axis[face >> 1] = (face & 1) == 0 ? 1.0 : -1.0;
        sum += textureLod(ambient_cube, axis, 16.0).rgb;
    }
    return sum * (frame.exposure.y / 6.0);
#endif
}

#endif
