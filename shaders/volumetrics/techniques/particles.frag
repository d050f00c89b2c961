// Spreads a particle over its disc, added to those before: no order is needed, for each has its own transmittance to the
// eye. The kernel is a function of the distance b between ray and centre, with an integral of 1 over the plane:
//     K(b) = 3 / (pi R^2) (1 - b^2 / R^2)^2.
// No pixel samples anything: noise is where the particles are, wider than what filters take away.
// Soft against depth, and where the eye is in it: the share of the diameter along the ray that lies between eye and surface.
#include "shaders/lib/phase.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

layout(early_fragment_tests) in;

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec4 center_radius;
layout(location = 1) flat in vec4 light;
layout(location = 2) flat in vec4 certain;  // a 1: of a local medium

// Sums of light and, for each channel where extinction is coloured, of what of it is known.
#if GLOBAL_MEDIA
layout(location = 0) out vec4 out_global;
#if CHROMATIC
layout(location = 1) out vec4 out_global_certain;
#endif
#endif
#if LOCAL_MEDIA
layout(location = GLOBAL_MEDIA * (1 + CHROMATIC)) out vec4 out_local;
#if CHROMATIC
layout(location = GLOBAL_MEDIA * 2 + 1) out vec4 out_local_certain;
#endif
#endif

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);

    float radius = center_radius.w;
    float t = dot(center_radius.xyz, ray.direction);
    vec3 beside = center_radius.xyz - ray.direction * t;
    float rest = max(1.0 - dot(beside, beside) / (radius * radius), 0.0);
    float share = clamp((min(surface, t + radius) - max(t - radius, 0.0)) / (2.0 * radius), 0.0, 1.0);
    float weight = share * rest * rest * 3.0 / (PI * radius * radius);
    float local = certain.a;
#if GLOBAL_MEDIA
    out_global = weight * (1.0 - local) * light;
#if CHROMATIC
    out_global_certain = weight * (1.0 - local) * certain;
#endif
#endif
#if LOCAL_MEDIA
    out_local = weight * local * light;
#if CHROMATIC
    out_local_certain = weight * local * certain;
#endif
#endif
    flush_work();
}
