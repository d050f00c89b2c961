// One depth for each block of factor x factor pixels of the host, which the low resolution is marched to. Buffer depth is
// reversed: the nearest is the largest, and 0 is the sky. Of blocks that the border cuts only pixels inside count.
#include "shaders/lib/work.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
uniform int factor;
uniform int choice;  // DepthChoice: 0 nearest, 1 farthest, 2 nearest where x + y is even, else farthest

layout(location = 0) out float out_depth;

void main() {
    ivec2 low = ivec2(gl_FragCoord.xy);
    ivec2 begin = low * factor;
    ivec2 end = min(begin + factor, textureSize(depth_texture, 0));
    float nearest = 0.0;
    float farthest = 1.0;
    for (int y = begin.y; y < end.y; ++y)
        for (int x = begin.x; x < end.x; ++x) {
            float depth = texelFetch(depth_texture, ivec2(x, y), 0).r;
            nearest = max(nearest, depth);
            farthest = min(farthest, depth);
        }
    bool is_nearest = choice == 0 || (choice == 2 && ((low.x + low.y) & 1) == 0);
    out_depth = is_nearest ? nearest : farthest;
    count_work(WORK_TEXTURE_FETCHES, uint((end.x - begin.x) * (end.y - begin.y)));
    flush_work();
}
