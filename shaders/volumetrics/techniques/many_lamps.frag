// Adds what froxels hold of the lamps that pixels do not take one by one, up to each pixel's depth, to scattering. Behind the end of
// the froxels there are none.
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/frame/apply.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(location = 0) out vec4 out_scattering;

void main() {
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float view_depth = view_depth_from_buffer(depth, volumetrics.eye.w);
    out_scattering = round_to_half(vec4(froxel_part(view_ray(screen_place(gl_FragCoord.xy)), view_depth, true).radiance, 0.0));
    flush_work();
}
