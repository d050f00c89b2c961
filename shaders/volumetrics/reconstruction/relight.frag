// The setting reconstruct = visibility: after the filter, light again at each pixel,
//     scattering = rest + sum over sun and lamps of (filtered share) / (filtered weight) * unshadowed light.
// Pixels without light have the weight 0: what is not known of their visibility does not spread.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"

layout(binding = 0) uniform sampler2D rest_texture;  // rgb radiance, a transmittance
#if SUN
layout(binding = 1) uniform sampler2D sun_light;
layout(binding = 2) uniform sampler2D sun_share;
#endif
#if LAMPS
layout(binding = 3) uniform sampler2D lamp_light;
layout(binding = 4) uniform sampler2D lamp_share;
#endif

layout(location = 0) out vec4 out_scattering;

vec3 relit(sampler2D light, sampler2D share, ivec2 pixel) {
    count_work(WORK_TEXTURE_FETCHES, 2u);
    vec4 factor = texelFetch(share, pixel, 0);
    return texelFetch(light, pixel, 0).rgb * max(factor.rgb, 0.0) / max(factor.a, 1.0e-7);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(rest_texture, pixel, 0);
    count_work(WORK_TEXTURE_FETCHES, 1u);
#if SUN
    sum.rgb += relit(sun_light, sun_share, pixel);
#endif
#if LAMPS
    sum.rgb += relit(lamp_light, lamp_share, pixel);
#endif
    out_scattering = round_to_half(sum);
    flush_work();
}
