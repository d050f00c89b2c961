// One level of the depth pyramid: the farthest depth (the least, reversed-Z) of the texels below. Level 0 has half the
// size of the depth buffer. Sizes round down; the last texel of a row or column also takes the odd one left over, so
// that texel min(p >> (level + 1), last) covers depth pixel p at every level.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D source;
layout(binding = 0, r32f) writeonly uniform image2D destination;

uniform int source_level;

void main() {
    ivec2 size = imageSize(destination);
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, size))) return;
    ivec2 last = textureSize(source, source_level) - 1;
    ivec2 end = mix(min(2 * p + 1, last), last, equal(p, size - 1));
    float farthest = 1.0;
    for (int y = 2 * p.y; y <= end.y; ++y)
        for (int x = 2 * p.x; x <= end.x; ++x)
            farthest = min(farthest, texelFetch(source, ivec2(x, y), source_level).r);
    imageStore(destination, p, vec4(farthest));
}
