// ray_march.frag as one of the steps in which the sun's share is interpolated along its lines.
#if OTHER_RAYS
#include "shaders/volumetrics/light/epipolar_samples.glsl"
layout(binding = UNIT_EPIPOLAR) uniform usampler2D sources;
layout(binding = UNIT_EPIPOLAR + 1) uniform sampler2D unwarped;
uniform int rays;
const int RAYS_OF_PIXELS = 0;
const int RAYS_OF_SAMPLES = 1;
const int RAYS_OF_PIXELS_LEFT = 2;  // without a sample of their surface

// Becomes the pixel that the texel drawn is computed for, and its ray; false: none.
bool chosen_ray(inout ivec2 pixel, inout Ray ray) {
    if (rays == RAYS_OF_SAMPLES) {
        EpipolarLines lines = epipolar_lines(epipolar_table, 0);
        ivec2 at = pixel;
        uint source = texelFetch(sources, at, 0).x;
        ray.direction = sample_direction(lines, at);
        ray.forward_cosine = forward_cosine(ray.direction);
        ray.visibility_direction = ray.direction;
        pixel = max(seen_pixel(ray.direction), 0);
        ray.uv = (vec2(pixel) + 0.5) / volumetrics.target.xy;
        return at.x < lines.samples && at.y < lines.lines && source == uint(at.x);
    }
    return rays == RAYS_OF_PIXELS || texelFetch(unwarped, pixel, 0).a == 0.0;
}

// Behind what the samples see, what they see last goes on.
void end_with_samples(inout EpipolarRay ray) {
    int made = int(texelFetch(epipolar_nodes, epipolar_texel(ray.root), 0).x);
    if (rays == RAYS_OF_PIXELS_LEFT) ray.last = max(made, 1) - 1;
}
#endif

#if EPIPOLAR == 2
layout(binding = UNIT_EPIPOLAR) uniform sampler2D unwarped;
layout(binding = UNIT_EPIPOLAR + 1) uniform sampler2D of_pixels_left;

vec3 unwarped_share(ivec2 pixel) {
    vec4 share = texelFetch(unwarped, pixel, 0);
    return share.a == 0.0 ? texelFetch(of_pixels_left, pixel, 0).rgb : share.rgb;
}
#endif
