// Lists of the lamps that reach each cluster, in the order of the light list. One invocation a cluster counts, takes
// its part of the pool and writes: only where a list lies in the pool depends on scheduling, never what it holds.
#include "shaders/engine/frame_block.glsl"
#include "shaders/engine/light_reach.glsl"
#include "shaders/engine/visible_lights.glsl"
#include "shaders/shared/lights.h"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_CLUSTERS) writeonly buffer ClusterBuffer { ClusterRange clusters[]; };
layout(std430, binding = BINDING_CLUSTER_LIGHTS) writeonly buffer ClusterLightBuffer { uint cluster_lights[]; };

struct Cluster {
    uvec3 index;
    bool bounded;  // the last slice is not
    vec3 center;   // view space box
    vec3 half_size;
};

Cluster cluster_of(uint id) {
    uvec3 size = frame.cluster_size.xyz;
    Cluster cluster;
    cluster.index = uvec3(id % size.x, (id / size.x) % size.y, id / (size.x * size.y));
    cluster.bounded = cluster.index.z + 1u < size.z;
    float near = cluster.index.z == 0u ? 0.0 : frame.depth.y * exp(float(cluster.index.z) / frame.depth.w);
    float far = frame.depth.y * exp(float(cluster.index.z + 1u) / frame.depth.w);
    vec2 tan_half_fov = 1.0 / vec2(frame.projection[0][0], frame.projection[1][1]);
    vec2 lo = (vec2(cluster.index.xy) / vec2(size.xy) * 2.0 - 1.0) * tan_half_fov;
    vec2 hi = (vec2(cluster.index.xy + 1u) / vec2(size.xy) * 2.0 - 1.0) * tan_half_fov;
    vec3 box_lo = vec3(min(lo * near, lo * far), -far);
    vec3 box_hi = vec3(max(hi * near, hi * far), -near);
    cluster.center = 0.5 * (box_lo + box_hi);
    cluster.half_size = 0.5 * (box_hi - box_lo);
    return cluster;
}

bool reaches(VisibleLight light, Cluster cluster) {
    uvec3 lo = light.index_box.yzw & 0xffffu;
    uvec3 hi = light.index_box.yzw >> 16;
    if (any(lessThan(cluster.index, lo)) || any(greaterThan(cluster.index, hi))) return false;
    if (!cluster.bounded) return true;
    vec3 gap = max(abs(light.sphere.xyz - cluster.center) - cluster.half_size, 0.0);
    if (dot(gap, gap) > light.sphere.w * light.sphere.w) return false;
    return light.axis_cosine.w <= -1.0 ||
           cone_meets_sphere(light.apex_range.xyz, light.axis_cosine.xyz, light.apex_range.w, light.axis_cosine.w,
                             cluster.center, length(cluster.half_size));
}

bool reached(uint i, Cluster cluster) { return i < visible_header.count && reaches(visible_lights[i], cluster); }

void main() {
    uint id = gl_GlobalInvocationID.x;
    uvec3 size = frame.cluster_size.xyz;
    if (id >= size.x * size.y * size.z) return;
    Cluster cluster = cluster_of(id);
    uint visible = visible_header.count;
    uint count = 0u;
    // Four a round: llvmpipe ends a shader's loops after 65,535 rounds in all.
    for (uint i = 0u; i < visible; i += 4u) {
        count += uint(reached(i, cluster)) + uint(reached(i + 1u, cluster)) + uint(reached(i + 2u, cluster)) +
                 uint(reached(i + 3u, cluster));
    }
    if (count == 0u) {
        clusters[id] = ClusterRange(0u, 0u);
        return;
    }
    uint offset = atomicAdd(visible_header.pool_used, count);
    clusters[id] = ClusterRange(offset, count);
    for (uint i = 0u; i < visible; i += 4u) {
        if (reached(i, cluster)) cluster_lights[offset++] = visible_lights[i].index_box.x;
        if (reached(i + 1u, cluster)) cluster_lights[offset++] = visible_lights[i + 1u].index_box.x;
        if (reached(i + 2u, cluster)) cluster_lights[offset++] = visible_lights[i + 2u].index_box.x;
        if (reached(i + 3u, cluster)) cluster_lights[offset++] = visible_lights[i + 3u].index_box.x;
    }
}
