// The froxels' light at each pixel's depth, and the transmittance. That of the local media is the one of their shapes along the
// pixel's own ray, not what froxels hold of it: it has no slices, and sharp rims. Behind the end of the froxels local media are
// lit by ambient light and an unshadowed sun, as the global ones are.
//
// LOCAL_MEDIA: some are in view.
#define LIGHT_VOLUMES (LOCAL_MEDIA + GRIDS)
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/frame/apply.glsl"
#if LOCAL_MEDIA
#include "shaders/volumetrics/light/local_segment.glsl"
#endif

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

March froxel_march(Ray ray, float surface, bool endless) {
    FroxelPart part = froxel_part(ray, surface, true);
    float begin = part.end;
#if LOCAL_MEDIA
    part.local_depth = to_extinction(local_optical_depth(ray, 0.0, begin));
#endif
    March march = March(part.radiance, exp(-(part.global_depth + part.local_depth)));
    if (surface <= froxel_far()) return march;
#if LOCAL_MEDIA
    const bool LIT = HAS_SUN > 0;
    find_chords(ray, begin, ray_distance_from_view_depth(surface, ray.forward_cosine), LIT);
    if (media_span.y > begin) {
        Extinction sun_front = Extinction(0.0);
#if HAS_SUN
        sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * begin, -sun_direction()));
#endif
        add_local_segments(ray, begin, media_span.y, ambient, sun_front, march);
        begin = media_span.y;
    }
#endif
    if (volumetrics.has_global != 0u) froxel_tail(ray, begin, surface, endless, ambient, march);
    return march;
}

void main() {
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    March march = froxel_march(view_ray(screen_place(gl_FragCoord.xy)), view_depth_from_buffer(depth, volumetrics.eye.w),
                               is_background(depth));
    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
    flush_work();
}
