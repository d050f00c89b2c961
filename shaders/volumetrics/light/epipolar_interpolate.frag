// All samples of the sun's lines, from those that ask the trees. rgb: source of sunlight (epipolar_sunlight.glsl), or -1
// where there is no medium; a: inverse distance, 1/m.
#include "shaders/volumetrics/light/epipolar_samples.glsl"
#include "shaders/lib/pack.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D table;
layout(binding = 2) uniform usampler2D between;  // which two of those that ask
layout(binding = 3) uniform usampler2D asking;
layout(binding = 4) uniform sampler2D asked;  // rgb source, a weight: 0 without a medium
layout(location = 0) out vec4 out_sample;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    EpipolarLines lines = epipolar_lines(table, 0);
    uvec2 ends = texelFetch(between, at, 0).xy;
    out_sample = vec4(0.0, 0.0, 0.0, NOT_SEEN);
    if (at.x < lines.samples && at.y < lines.lines && ends.x != 0xffffu) {
        vec4 left = texelFetch(asked, ivec2(ends.x, at.y), 0);
        vec4 right = texelFetch(asked, ivec2(ends.y, at.y), 0);
        float begin = float(texelFetch(asking, ivec2(ends.x, at.y), 0).x);
        float end = float(texelFetch(asking, ivec2(ends.y, at.y), 0).x);
        float place = ends.x == ends.y ? 0.0 : (float(at.x) - begin) / (end - begin);
        vec2 weight = vec2(1.0 - place, place) * vec2(left.a, right.a);
        float sum = weight.x + weight.y;
        vec3 direction = sample_direction(lines, at);
        float depth = texelFetch(depth_texture, seen_pixel(direction), 0).r;
        count_work(WORK_TEXTURE_FETCHES, 6u);
        out_sample.rgb = sum > 0.0 ? (weight.x * left.rgb + weight.y * right.rgb) / sum : vec3(-1.0);
        out_sample.a = inverse_distance(depth, direction);
    }
    out_sample = round_to_half(out_sample);
    flush_work();
}
