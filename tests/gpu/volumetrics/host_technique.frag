// A host's technique: fog of one segment in closed form, and of the sun one visibility, at noise.
#include "shaders/lib/pack.glsl"
#include "shaders/interface/shadows.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
layout(location = 0) out vec4 out_rest;
layout(location = 1) out vec4 out_sun;
layout(location = 2) out vec4 out_share;

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    float end = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    Medium medium = global_medium(ray.origin.y, ray.direction.y, end);
    Optics optics = medium_optics(medium, end);
    float t = end * noise_offset(uvec2(gl_FragCoord.xy));
    out_rest = vec4(vec3(0.0), average(optics.transmittance));
    out_sun = round_to_half(vec4(sun_scattering(ray, medium, optics.effective_length), 0.0));
    out_share = vec4(vec3(sun_visibility(ray.origin + t * ray.direction, t * ray.forward_cosine)), 1.0);
}
