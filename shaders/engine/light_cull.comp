// The lamps whose reach meets the view frustum and is not hidden behind what the depth buffer holds, compacted in the
// order of the light list by prefix sums in one workgroup, so that the result does not depend on scheduling. The rows of
// clusters that each may reach are marked.
#include "shaders/engine/light_data.glsl"
#include "shaders/engine/light_reach.glsl"
#include "shaders/engine/visible_lights.glsl"

#define GROUP 256
layout(local_size_x = GROUP) in;

#if OCCLUSION
layout(binding = 0) uniform sampler2D pyramid;

// Whether all depth pixels of the rectangle are nearer than the sphere's nearest point. It reads the level at which at
// most 4 x 4 texels cover the rectangle; level k of the pyramid stands for depth pixels shifted right by k + 1.
bool is_hidden(ScreenBounds bounds) {
    if (bounds.near <= frame.depth.x) return false;
    vec2 last = frame.viewport.xy - 1.0;
    ivec2 lo = ivec2(clamp((bounds.lo * 0.5 + 0.5) * frame.viewport.xy, vec2(0.0), last));
    ivec2 hi = ivec2(clamp((bounds.hi * 0.5 + 0.5) * frame.viewport.xy, vec2(0.0), last));
    int level = 0;
    int top = textureQueryLevels(pyramid) - 1;
    while (level < top && any(greaterThan((hi >> (level + 1)) - (lo >> (level + 1)), ivec2(3)))) ++level;
    // Not textureSize(pyramid, level): llvmpipe takes one invocation's level for all.
    ivec2 last_texel = max(textureSize(pyramid, 0) >> level, ivec2(1)) - 1;
    lo = min(lo >> (level + 1), last_texel);
    hi = min(hi >> (level + 1), last_texel);
    float farthest = 1.0;
    for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x) farthest = min(farthest, texelFetch(pyramid, ivec2(x, y), level).r);
    return frame.depth.x / bounds.near < farthest;
}
#endif

uint packed_range(float lo, float hi, uint count) {
    uvec2 range = uvec2(clamp(vec2(lo, hi), 0.0, float(count) - 0.5));
    return range.x | (range.y << 16);
}

// Of the rows from `first` on those that a packed range holds.
void mark_rows(uint first, uint range, uint place, uint words) {
    for (uint row = range & 0xffffu; row <= range >> 16; ++row)
        atomicOr(visible_rows[(first + row) * words + place / 32u], 1u << (place % 32u));
}

shared uint sums[GROUP];
shared uint hidden_count;

// Inclusive prefix sum over the group (Hillis and Steele 1986).
uint prefix_sum(uint value) {
    uint id = gl_LocalInvocationID.x;
    sums[id] = value;
    barrier();
    for (uint step = 1u; step < GROUP; step *= 2u) {
        uint below = id >= step ? sums[id - step] : 0u;
        barrier();
        sums[id] += below;
        barrier();
    }
    return sums[id];
}

void main() {
    uint id = gl_LocalInvocationID.x;
    uint light_count = frame.cluster_size.w;
    vec2 tan_half_fov = 1.0 / vec2(frame.projection[0][0], frame.projection[1][1]);
    vec2 grid = vec2(frame.cluster_size.xy);
    uint found = 0u;
    if (id == 0u) hidden_count = 0u;

    for (uint base = 0u; base < light_count; base += GROUP) {
        uint index = base + id;
        bool visible = index < light_count;
        VisibleLight record;
        if (visible) {
            GpuLight light = light_data(index);
            bool spot = light.direction_type.w == float(LIGHT_SPOT);
            float range = light.position_range.w;
            float cosine = spot ? cone_cosine(light.cone_shadow.xy) : -1.0;
            vec3 apex = (frame.view * vec4(light.position_range.xyz, 1.0)).xyz;
            vec3 axis = mat3(frame.view) * light.direction_type.xyz;
            vec4 sphere = spot ? cone_reach(apex, axis, range, cosine) : vec4(apex, range);
            ScreenBounds bounds = screen_bounds(sphere.xyz, sphere.w, tan_half_fov);
            visible = bounds.far > frame.depth.x && all(lessThan(bounds.lo, vec2(1.0))) &&
                      all(greaterThan(bounds.hi, vec2(-1.0)));
#if OCCLUSION
            if (visible && is_hidden(bounds)) {
                visible = false;
                atomicAdd(hidden_count, 1u);
            }
#endif
            vec2 lo = (bounds.lo * 0.5 + 0.5) * grid;
            vec2 hi = (bounds.hi * 0.5 + 0.5) * grid;
            record.sphere = sphere;
            record.apex_range = vec4(apex, range);
            record.axis_cosine = vec4(axis, cosine);
            record.index_box = uvec4(index, packed_range(lo.x, hi.x, frame.cluster_size.x),
                                     packed_range(lo.y, hi.y, frame.cluster_size.y),
                                     uint(cluster_slice(bounds.near)) | (uint(cluster_slice(bounds.far)) << 16));
        }
        uint place = prefix_sum(visible ? 1u : 0u);
        if (visible) {
            uint at = found + place - 1u;
            uvec3 size = frame.cluster_size.xyz;
            visible_lights[at] = record;
            mark_rows(0u, record.index_box.y, at, row_words(light_count));
            mark_rows(size.x, record.index_box.z, at, row_words(light_count));
            mark_rows(size.x + size.y, record.index_box.w, at, row_words(light_count));
        }
        found += sums[GROUP - 1];
        barrier();
    }
    barrier();
    if (id == 0u) visible_header = VisibleLightsHeader(found, 0u, hidden_count, 0u);
}
