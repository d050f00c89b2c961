// Second step of a light volume: sums the slabs along each ray, so that a texel holds the optical depth from the light up
// to it. In place: each invocation has its own texels.
#include "shaders/lib/pack.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if CHROMATIC
layout(rgba16f, binding = 0) uniform image3D volume;
#else
layout(r16f, binding = 0) uniform image3D volume;
#endif

uniform ivec3 origin;
uniform ivec3 size;

void main() {
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) return;
    vec3 depth = vec3(0.0);
    for (int k = 0; k < size.z; ++k) {
        ivec3 texel = origin + ivec3(column, k);
        depth = min(depth + imageLoad(volume, texel).rgb, vec3(HALF_MAX));
        imageStore(volume, texel, round_to_half(vec4(depth, 1.0)));
    }
}
