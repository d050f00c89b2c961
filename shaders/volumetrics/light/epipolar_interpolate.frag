// The samples of the sun's lines that ask no trees, between those that do. rgb: visible share of the sunlight, or -1 where
// there is none; a: inverse distance, 1/m.
#include "shaders/volumetrics/light/epipolar_samples.glsl"
#include "shaders/lib/pack.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D table;
layout(binding = 2) uniform usampler2D sources;
layout(binding = 3) uniform sampler2D asked;  // rgb share, a weight: 0 without light
layout(location = 0) out vec4 out_sample;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    EpipolarLines lines = epipolar_lines(table, 0);
    uvec2 source = texelFetch(sources, at, 0).xy;
    out_sample = vec4(0.0, 0.0, 0.0, NOT_SEEN);
    if (at.x < lines.samples && at.y < lines.lines && source.x != 0xffffu) {
        vec4 left = texelFetch(asked, ivec2(source.x, at.y), 0);
        vec4 right = texelFetch(asked, ivec2(source.y, at.y), 0);
        float place = source.x == source.y ? 0.0 : float(at.x - int(source.x)) / float(source.y - source.x);
        vec2 weight = vec2(1.0 - place, place) * vec2(left.a, right.a);
        float sum = weight.x + weight.y;
        vec3 direction = sample_direction(lines, at);
        float depth = texelFetch(depth_texture, seen_pixel(direction), 0).r;
        count_work(WORK_TEXTURE_FETCHES, 4u);
        out_sample.rgb = sum > 0.0 ? (weight.x * left.rgb + weight.y * right.rgb) / sum : vec3(-1.0);
        out_sample.a = inverse_distance(depth, direction);
    }
    out_sample = round_to_half(out_sample);
    flush_work();
}
