// The froxels' light and transmittance at each pixel's depth.
#define LOCAL_MEDIA 1
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/frame/apply.glsl"

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

void main() {
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    March march = froxel_march(screen_place(gl_FragCoord.xy),
                               view_depth_from_buffer(depth, volumetrics.eye.w), true, is_background(depth), ambient);
    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
    flush_work();
}
