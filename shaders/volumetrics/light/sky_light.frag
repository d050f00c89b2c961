// Light of the sky that the media of a view ray scatter, where it differs from place to place (ambient_radiance_at): added to what a
// technique has made without ambient light. It is smooth and has no noise: each step asks for it in its middle.
//
// LOCAL_MEDIA: some are in view.
#define SKY_ALONE 1
#define LIGHT_VOLUMES 0

#include "shaders/volumetrics/media/froxel_grid.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#if LOCAL_MEDIA
#include "shaders/volumetrics/light/local_segment.glsl"
#endif

layout(early_fragment_tests) in;
layout(binding = 0) uniform sampler2D depth_texture;
layout(location = 0) out vec4 out_radiance;

uniform int steps;
uniform float nearest;  // view depth, m: froxels have the light of what lies before

const float GROWTH = 1.5;  // steps end at this power of equal shares

void add_step(Ray ray, float begin, float end, inout March march) {
    Ambient ambient = ambient_at(ray, 0.5 * (begin + end));
    Extinction sun_front = Extinction(0.0);
#if LOCAL_MEDIA
    add_local_segments(ray, begin, end, ambient, sun_front, march);
#else
    add_global(ray, begin, end, ambient, sun_front, march);
#endif
}

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    float begin = nearest > 0.0 ? ray_distance_from_view_depth(nearest, ray.forward_cosine) : 0.0;
    float end = min(surface, max(volumetrics.max_distance, begin));
    March march = March(vec3(0.0), exp(-global_optical_depth(ray, 0.0, begin)));
#if LOCAL_MEDIA
    march.transmittance *= exp(-to_extinction(local_optical_depth(ray, 0.0, begin)));
    const bool LIT = false;
    find_chords(ray, begin, surface, LIT);
    // Without a global medium only the part of the ray that lies in local ones.
    if (volumetrics.has_global == 0u) {
        begin = min(media_span.x, end);
        end = min(end, media_span.y);
    }
#endif
    float a = begin;
    for (int i = 1; i <= steps && a < end; ++i) {
        float b = mix(begin, end, pow(float(i) / float(steps), GROWTH));
        add_step(ray, a, b, march);
        a = b;
    }
#if LOCAL_MEDIA
    // Local media behind max_distance are one step more.
    if (begin < surface && media_span.y > max(a, end)) {
        add_step(ray, a, media_span.y, march);
        a = media_span.y;
    }
#endif
    if (volumetrics.has_global != 0u && surface > a)
        march_tail(ray, a, surface, is_background(depth), ambient_at(ray, a), Extinction(0.0), march);
    out_radiance = vec4(march.radiance, 0.0);
    flush_work();
}
