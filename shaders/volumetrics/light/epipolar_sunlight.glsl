// The sunlight of view rays as it is interpolated along the sun's lines. A ray that lets the share T through has
//     L = E * S * (1 - T),    E the sun's illuminance, S the source (1/sr): among samples S varies little,
// for in one medium L is in proportion to 1 - T whatever the length of the ray, and T is known at each pixel.
#if SUN_ALONE
#include "shaders/volumetrics/light/epipolar_samples.glsl"
layout(binding = UNIT_EPIPOLAR) uniform usampler2D asking;
layout(binding = UNIT_EPIPOLAR + 1) uniform sampler2D wanted;  // as in epipolar_rays.vert
uniform bool of_samples;  // else of pixels that have none of their surface

bool is_wanted(ivec2 at) {
    return of_samples ? float(at.x) < texelFetch(wanted, ivec2(at.y, 0), 0).y : texelFetch(wanted, at, 0).a == 0.0;
}

// The ray of the sample whose texel `at` is, and the pixel it falls in.
Ray sample_ray(ivec2 at, out ivec2 pixel) {
    EpipolarLines lines = epipolar_lines(epipolar_table, 0);
    vec3 direction = sample_direction(lines, ivec2(texelFetch(asking, at, 0).x, at.y));
    pixel = max(seen_pixel(direction), 0);
    return Ray(volumetrics.eye.xyz, direction, forward_cosine(direction), (vec2(pixel) + 0.5) / volumetrics.target.xy,
               direction);
}

// Behind what the samples see, what they see last goes on.
void end_with_samples(inout EpipolarRay ray) {
    int made = int(texelFetch(epipolar_nodes, epipolar_texel(ray.root), 0).x);
    if (!of_samples) ray.last = max(made, 1) - 1;
}

// rgb: S; a: 1, or 0 where there is no medium.
vec4 sun_source(vec3 radiance, Extinction transmittance) {
    const float LEAST = 1.0e-6;
    vec3 opacity = vec3(1.0) - transmittance;
    vec3 light = max(sun_illuminance() * opacity, 1.0e-30);
    vec3 source = min(radiance / light, 6.0e4);
    return mean_channel(opacity) > LEAST ? round_to_half(vec4(source, 1.0)) : vec4(0.0);
}
#endif

#if EPIPOLAR == 2
layout(binding = UNIT_EPIPOLAR) uniform sampler2D unwarped;
layout(binding = UNIT_EPIPOLAR + 1) uniform sampler2D fixed_up;

vec3 sunlight(ivec2 pixel, Extinction transmittance) {
    vec4 source = texelFetch(unwarped, pixel, 0);
    count_work(WORK_TEXTURE_FETCHES, 2u);
    if (source.a == 0.0) source = texelFetch(fixed_up, pixel, 0);
    return sun_illuminance() * source.rgb * (vec3(1.0) - transmittance);
}
#endif
