// Light shafts as a post-process: the closed form of fog.glsl, its sun a part by itself, whose visible share
// radial_visibility.frag finds on screen and reconstruction frees of noise. Fog itself is neither dithered nor filtered.
// Without an occluder on screen it is the closed form itself.
// Further suns are part of the fog.
// It cannot: occluders off screen or hidden behind others, a sun that is not on screen (behind the camera, or beyond the
// border: then the share radial_unseen of the sun is all there is), lamps, local media. Where in the fog a shadow lies it
// knows only for the transmittance towards the eye, not for colour or phase, which are those of the whole ray.
#define HAS_SUN 1
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/techniques/fog.glsl"

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
layout(location = 1) out vec4 out_sun;
#if CHROMATIC
layout(location = 2) out vec4 out_transmittance;
#endif

void main() {
    Ray ray = view_ray(gl_FragCoord.xy * volumetrics.viewport.zw);
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    ClosedFormFog fog = fog_over_ray(ray, surface, is_background(depth), ambient);
    out_scattering = round_to_half(vec4(fog.glow, average(fog.transmittance)));
    out_sun = round_to_half(vec4(fog.sun, 0.0));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(fog.transmittance, average(fog.transmittance)));
#endif
    flush_work();
}
