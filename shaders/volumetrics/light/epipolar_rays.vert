// Rectangles over the texels of epipolar_sunlight.glsl that are wanted, an instance each: of samples the part of four lines
// that holds those that ask; of pixels a tile of 16 x 16 where some pixel has no sample of its surface.
#include "shaders/shared/bindings.h"

layout(location = 0) flat out vec3 ambient;
layout(binding = UNIT_EPIPOLAR + 1) uniform sampler2D wanted;  // counts of lines, or what was unwarped
uniform bool of_samples;
uniform ivec2 target;  // px

void main() {
    const int LINES = 4;
    const int TILE = 16;
    ivec2 first = ivec2(0, LINES * gl_InstanceID);
    ivec2 size = ivec2(0);
    if (of_samples) {
        for (int i = 0; i < LINES; ++i) size.x = max(size.x, int(texelFetch(wanted, ivec2(first.y + i, 0), 0).y));
        size.y = size.x > 0 ? LINES : 0;
    } else {
        int across = (target.x + TILE - 1) / TILE;
        first = TILE * ivec2(gl_InstanceID % across, gl_InstanceID / across);
        float least = 1.0;
        for (int i = 0; i < TILE * TILE / 4; ++i) {
            ivec2 corner = first + 2 * ivec2(i % (TILE / 2), i / (TILE / 2)) + 1;
            vec4 four = textureGather(wanted, vec2(corner) / vec2(target), 3);
            least = min(least, min(min(four.x, four.y), min(four.z, four.w)));
        }
        size = least == 0.0 ? ivec2(TILE) : ivec2(0);
    }
    vec2 corner = vec2(first + size * ivec2(gl_VertexID & 1, gl_VertexID >> 1));
    gl_Position = vec4(2.0 * corner / vec2(target) - 1.0, 0.0, 1.0);
    ambient = vec3(0.0);
}
