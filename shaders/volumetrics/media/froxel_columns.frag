// View depth [m] of the farthest thing that is seen through each column of froxels; TRANSPARENTS: of the farthest transparent,
// 0 where there is none, or all are hidden.
#include "shaders/lib/depth.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
uniform vec2 column_count;

#if TRANSPARENTS
// For each column, along x first: nearest and farthest view depth [m] of transparents, {infinity, 0} without any.
layout(std430, binding = BINDING_TRANSPARENT_DEPTHS) readonly buffer TransparentDepths { vec2 transparent_depths[]; };
#endif

layout(location = 0) out float farthest_view_depth;

void main() {
    // All pixels that the column touches: some when there are fewer pixels than columns, too.
    ivec2 last = ivec2(volumetrics.viewport.xy) - 1;
    vec2 column_size = volumetrics.viewport.xy / column_count;
    vec2 column = floor(gl_FragCoord.xy);
#if TRANSPARENTS
    vec2 transparents = transparent_depths[int(column.y) * int(column_count.x) + int(column.x)];
    if (transparents.y <= 0.0) {
        farthest_view_depth = 0.0;
        flush_work();
        return;
    }
#endif
    ivec2 lower = clamp(ivec2(floor(column * column_size + 1.0e-3)), ivec2(0), last);
    ivec2 upper = clamp(ivec2(ceil((column + 1.0) * column_size - 1.0e-3)) - 1, lower, last);
    float farthest = 1.0;
    for (int y = lower.y; y <= upper.y; ++y) {
        for (int x = lower.x; x <= upper.x; ++x)
            farthest = min(farthest, texelFetch(depth_texture, ivec2(x, y), 0).r);
        count_work(WORK_TEXTURE_FETCHES, uint(upper.x - lower.x + 1));
    }
    farthest_view_depth = view_depth_from_buffer(farthest, volumetrics.eye.w);
#if TRANSPARENTS
    farthest_view_depth = transparents.x <= farthest_view_depth ? min(farthest_view_depth, transparents.y) : 0.0;
#endif
    flush_work();
}
