// How the sunlight of each pixel was found. Green: its nearest sample asked the trees; blue: that is of an odd line; red: it has
// no sample of its surface and was marched.
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/light/epipolar_samples.glsl"

layout(binding = 0) uniform sampler2D table;
layout(binding = 1) uniform usampler2D between;
layout(binding = 2) uniform sampler2D unwarped;
layout(location = 0) out vec4 out_color;

void main() {
    EpipolarLines lines = epipolar_lines(table, 0);
    ivec2 at = ivec2(sample_place(lines, view_ray(screen_place(gl_FragCoord.xy)).direction) + 0.5);
    uvec2 ends = texelFetch(between, clamp(at, ivec2(0), ivec2(lines.samples, lines.lines) - 1), 0).xy;
    bool marched = texelFetch(unwarped, ivec2(gl_FragCoord.xy), 0).a == 0.0;
    out_color = vec4(marched, ends.x == ends.y && ends.x != 0xffffu, 0.5 * float(at.y & 1), 1.0);
}
