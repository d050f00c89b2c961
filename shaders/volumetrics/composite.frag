// Pre-multiplied: color = scattering + color * transmittance, done by blending.
#include "shaders/lib/work.glsl"

layout(binding = 1) uniform sampler2D scattering_texture;
#if CHROMATIC
layout(binding = 2) uniform sampler2D transmittance_texture;
#endif

layout(location = 0) in vec2 uv;
layout(location = 0, index = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 0, index = 1) out vec4 out_transmittance;
#endif

void main() {
    out_scattering = textureLod(scattering_texture, uv, 0.0);
#if CHROMATIC
    out_transmittance = textureLod(transmittance_texture, uv, 0.0);
#endif
    count_work(WORK_TEXTURE_FETCHES, uint(1 + CHROMATIC));
    flush_work();
}
