// Lists of the lamps that reach each cluster, in the order of the light list. One invocation a cluster takes part of the
// pool for all that may reach it and writes those that do: only where a list lies in the pool depends on scheduling, never
// what it holds.
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
    if (!cluster.bounded) return true;
    vec3 gap = max(abs(light.sphere.xyz - cluster.center) - cluster.half_size, 0.0);
    if (dot(gap, gap) > light.sphere.w * light.sphere.w) return false;
    return light.axis_cosine.w <= -1.0 ||
           cone_meets_sphere(light.apex_range.xyz, light.axis_cosine.xyz, light.apex_range.w, light.axis_cosine.w,
                             cluster.center, length(cluster.half_size));
}

// Lamps 32 word to 32 word + 31 whose box holds the cluster.
uint may_reach(uint word, uvec3 index) {
    uvec3 size = frame.cluster_size.xyz;
    uint words = row_words(frame.cluster_size.w);
    return visible_rows[index.x * words + word] & visible_rows[(size.x + index.y) * words + word] &
           visible_rows[(size.x + size.y + index.z) * words + word];
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    uvec3 size = frame.cluster_size.xyz;
    if (id >= size.x * size.y * size.z) return;
    Cluster cluster = cluster_of(id);
    uint words = row_words(visible_header.count);
    uint most = 0u;
    for (uint word = 0u; word < words; ++word) most += uint(bitCount(may_reach(word, cluster.index)));
    if (most == 0u) {
        clusters[id] = ClusterRange(0u, 0u);
        return;
    }
    uint offset = atomicAdd(visible_header.pool_used, most);
    uint count = 0u;
    for (uint word = 0u; word < words; ++word) {
        for (uint bits = may_reach(word, cluster.index); bits != 0u; bits &= bits - 1u) {
            VisibleLight light = visible_lights[32u * word + uint(findLSB(bits))];
            if (reaches(light, cluster)) cluster_lights[offset + count++] = light.index_box.x;
        }
    }
    clusters[id] = ClusterRange(offset, count);
}
