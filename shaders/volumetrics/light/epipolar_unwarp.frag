// From samples along the sun's lines to pixels: the four round a pixel, bilinear, each as far as its surface is the
// pixel's. rgb: source of sunlight (epipolar_sunlight.glsl); a: 1, or 0 where no sample is of the pixel's surface.
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/light/epipolar_samples.glsl"
#include "shaders/lib/pack.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D table;
layout(binding = 2) uniform sampler2D samples;
layout(location = 0) out vec4 out_source;

void main() {
    const float LEAST = 0.01;
    EpipolarLines lines = epipolar_lines(table, 0);
    vec3 direction = view_ray(screen_place(gl_FragCoord.xy)).direction;
    float inverse = inverse_distance(texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r, direction);
    float cosine = dot(direction, lines.axis);
    vec3 across = direction - cosine * lines.axis;
    vec2 place = vec2(atan(length(across), cosine) * lines.samples_per_radian - lines.first_sample,
                      epipolar_line(lines, across) - 0.5);
    bool whole_turn = float(lines.lines) > EPIPOLAR_TWO_PI * lines.lines_per_radian - 0.5;
    ivec2 low = ivec2(floor(place));
    vec2 part = place - vec2(low);
    float weights = 0.0;
    vec4 lit = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = ivec2(i & 1, i >> 1);
        ivec2 at = low + beside;
        if (whole_turn) at.y = (at.y + lines.lines) % lines.lines;
        vec4 s = texelFetch(samples, clamp(at, ivec2(0), ivec2(lines.samples, lines.lines) - 1), 0);
        vec2 near = mix(1.0 - part, part, vec2(beside));
        float alike = 1.0 - abs(s.a - inverse) / same_surface(inverse);
        float weight = s.a == NOT_SEEN ? 0.0 : near.x * near.y * max(alike, 0.0);
        weights += weight;
        if (s.r >= 0.0) lit += weight * vec4(s.rgb, 1.0);
    }
    count_work(WORK_TEXTURE_FETCHES, 8u);
    out_source = round_to_half(vec4(lit.rgb / max(lit.a, 1.0e-7), weights < LEAST ? 0.0 : 1.0));
    flush_work();
}
