// Adds to each cell the light of the sky from some directions, as far as it sees them: one invocation a cell.
#include "shaders/lib/pack.glsl"
#include "shaders/shared/sky_volume.h"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(std430, binding = 0) readonly buffer DirectionBuffer { SkyDirection directions[]; };
layout(binding = 0) uniform sampler2DArrayShadow maps;  // of the casters, seen from the sky
layout(rgba16f, binding = 0) uniform image3D sums;      // a slab for red, green, blue

uniform ivec3 cells;
uniform vec3 low;    // centre of the first cell, m
uniform float size;  // of a cell, m
uniform int count;   // of directions

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) return;
    vec4 point = vec4(low + size * vec3(cell), 1.0);
    mat3x4 sum = mat3x4(0.0);
    for (int i = 0; i < count; ++i) {
        vec3 place = (directions[i].world_to_map * point).xyz;
        float visible = texture(maps, vec4(place.xy, float(i), place.z));
        sum[0] += visible * directions[i].red;
        sum[1] += visible * directions[i].green;
        sum[2] += visible * directions[i].blue;
    }
    for (int c = 0; c < 3; ++c) {
        ivec3 at = cell + ivec3(0, 0, c * cells.z);
        imageStore(sums, at, round_to_half(imageLoad(sums, at) + sum[c]));
    }
}
