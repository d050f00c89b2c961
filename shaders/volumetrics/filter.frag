// One direction of a 15-tap separable Gaussian, of scattering and transmittance. BILATERAL 1 weighs each tap by depth too.
#include "shaders/lib/work.glsl"
#include "shaders/lib/pack.glsl"

const int RADIUS = 7;

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D scattering_texture;
#if CHROMATIC
layout(binding = 2) uniform sampler2D transmittance_texture;
#endif
uniform vec4 weights_0_3;  // by distance from the centre, px
uniform vec4 weights_4_7;
uniform vec2 step_uv;  // one texel in the direction of the blur
uniform float depth_falloff;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

// Falls linearly with the difference of the view depths z relative to the farther one, 1 - falloff |z0 - z1| / max(z),
// down to 0. Relative, because the depth step between the neighbours of one surface grows with its distance. Buffer
// depth is near / z, so the quotient of two depths needs no conversion; 0 is the sky, like itself and nothing else.
float depth_weight(float d0, float d1) {
    float low = min(d0, d1);
    float high = max(d0, d1);
    if (low == 0.0) return high == 0.0 ? 1.0 : 0.0;
    return max(1.0 - depth_falloff * (1.0 - low / high), 0.0);
}

float depth_at(vec2 p) { return textureLod(depth_texture, p, 0.0).r; }

void main() {
    vec4 sum = textureLod(scattering_texture, uv, 0.0) * weights_0_3.x;
#if CHROMATIC
    vec4 transmittance = textureLod(transmittance_texture, uv, 0.0) * weights_0_3.x;
#endif
    float total = weights_0_3.x;
#if BILATERAL
    float centre_depth = depth_at(uv);
#endif
    for (int i = 1; i <= RADIUS; ++i) {
        float spatial = i < 4 ? weights_0_3[i] : weights_4_7[i - 4];
        for (int side = -1; side <= 1; side += 2) {
            vec2 p = uv + step_uv * float(i * side);
            float weight = spatial;
#if BILATERAL
            weight *= depth_weight(centre_depth, depth_at(p));
#endif
            sum += textureLod(scattering_texture, p, 0.0) * weight;
#if CHROMATIC
            transmittance += textureLod(transmittance_texture, p, 0.0) * weight;
#endif
            total += weight;
        }
    }
    count_work(WORK_TEXTURE_FETCHES, uint((2 * RADIUS + 1) * (1 + BILATERAL + CHROMATIC)));
    out_scattering = round_to_half(sum / total);
#if CHROMATIC
    out_transmittance = round_to_half(transmittance / total);
#endif
    flush_work();
}
