// color = scattering + color * transmittance, read and written in place (behind a texture barrier) instead of blended:
// blending has no limit, and the sum of two layers overflows half floats.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"

layout(binding = 0) uniform sampler2D color_texture;  // the target itself
layout(binding = 1) uniform sampler2D scattering_texture;
#if CHROMATIC
layout(binding = 2) uniform sampler2D transmittance_texture;
#endif

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 out_color;

void main() {
    vec4 scattering = textureLod(scattering_texture, uv, 0.0);
    vec4 transmittance = vec4(scattering.a);
#if CHROMATIC
    transmittance.rgb = textureLod(transmittance_texture, uv, 0.0).rgb;
#endif
    count_work(WORK_TEXTURE_FETCHES, uint(1 + CHROMATIC));
    vec4 color = texelFetch(color_texture, ivec2(gl_FragCoord.xy), 0);
    out_color = round_to_half(vec4(scattering.rgb, 0.0) + color * transmittance);
    flush_work();
}
