// The last step of reconstruction, at the host's resolution: of PARTS parts light again at each pixel,
//     scattering = rest + sum over the parts of (filtered share) / (filtered weight) * unshadowed light.
// Pixels without light have the weight 0: what is not known of their visibility does not spread.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"

layout(binding = 0) uniform sampler2D rest_texture;         // rgb radiance, a transmittance
layout(binding = 1) uniform sampler2D textures[2 * PARTS];  // of each part its light, then its share

layout(location = 0) out vec4 out_scattering;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(rest_texture, pixel, 0);
    for (int i = 0; i < PARTS; ++i) {
        vec4 share = texelFetch(textures[2 * i + 1], pixel, 0);
        sum.rgb += texelFetch(textures[2 * i], pixel, 0).rgb * max(share.rgb, 0.0) / max(share.a, 1.0e-7);
    }
    count_work(WORK_TEXTURE_FETCHES, uint(1 + 2 * PARTS));
    out_scattering = round_to_half(sum);
    flush_work();
}
