// Radiance that a segment of a view ray sends to its front.
#ifndef VOLUMETRICS_SEGMENT_LIGHT_GLSL
#define VOLUMETRICS_SEGMENT_LIGHT_GLSL

#include "shaders/interface/shadows.glsl"
#include "shaders/volumetrics/light/lamps.glsl"

// 1: unshadowed light is wanted without noise (ray_march.frag).
#ifndef PARTS
#define PARTS 0
#endif

#include "shaders/volumetrics/light/segment.glsl"

struct SegmentLight {
    vec3 diffuse;  // ambient light and emission
    vec3 sun;      // unshadowed
    Visibility sun_visibility;
    vec3 lamps;
    vec3 unshadowed_lamps;
};

#if HAS_SUN
// Sunlight gathered a metre falls along the segment by exp(-fall): by the optical depth x of SunSegment, and as height
// media get thinner.
float sunlight_fall(Ray ray, Segment segment, float x) {
#if HEIGHT_MEDIA
    vec3 front = segment.sigma_s + height_sigma_s(ray.origin.y + ray.direction.y * segment.begin);
    vec3 behind = segment.sigma_s + height_sigma_s(ray.origin.y + ray.direction.y * segment.end);
    x += log(max(mean_channel(front), 1.0e-30) / max(mean_channel(behind), 1.0e-30));
#endif
    return x;
}

// What the local media leave of sunlight on its way to the segment: the mean over two points, each in its half of the
// light gathered.
vec3 local_sun_transmittance(Ray ray, Segment segment, float fall) {
#if LIGHT_VOLUMES
    float path_length = segment.end - segment.begin;
    float offset = FROXEL_HISTORY == 0 && PARTS == 0 ? segment.offset : 0.5;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float t = segment.begin + path_length * equal_transmittance(0.5 * (offset + float(i)), fall);
        sum += exp(-local_sun_optical_depth(ray.origin + ray.direction * t));
    }
    return 0.5 * sum;
#else
    return vec3(1.0);
#endif
}

// FROXEL_HISTORY keeps one number for the visibility of the sun: so the colour of glass is the light's own, that on the ray.
#if SUN_GLASS && FROXEL_HISTORY
vec3 glass_over_segment(Ray ray, Segment segment, float fall) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float t = mix(segment.begin, segment.end, equal_transmittance(0.25 + 0.5 * float(i), fall));
        count_work(WORK_TEXTURE_FETCHES, 1u);
        sum += sun_filter(ray.origin + ray.direction * t, t * ray.forward_cosine);
    }
    return 0.5 * sum;
}
#endif
#endif

// segment.offset: 0..1, where the segment is sampled, see below. `m` and `optics`: its medium. sun_front: the optical
// depth towards the sun at the segment's begin; becomes that at its end.
SegmentLight segment_light_parts(Ray ray, Segment segment, Medium m, Optics optics, Ambient ambient,
                                 inout Extinction sun_front) {
    float path_length = segment.end - segment.begin;
    SegmentLight light = SegmentLight(vec3(0.0), vec3(0.0), Visibility(1.0), vec3(0.0), vec3(0.0));
    light.diffuse = ambient_glow(m, ambient) * optics.effective_length;

#if HAS_SUN
    // Visibility is sampled where that share of the light has been gathered.
    SunSegment sun = sun_segment(ray, segment.begin, segment.end, optics, sun_front);
    float fall = sunlight_fall(ray, segment, sun.x);
    light.sun_visibility = sun_share(ray, segment.begin, segment.end, fall, segment.offset);
    light.sun = sun_scattering(ray, m, sun.effective_length) * local_sun_transmittance(ray, segment, fall);
#if SUN_GLASS && FROXEL_HISTORY
    light.sun *= glass_over_segment(ray, segment, fall);
#endif
#endif

#if LAMPS == 1
    float t_visibility = segment.begin + segment.offset * path_length;
    float t_lamps = FROXEL_HISTORY == 0 ? t_visibility : segment.begin + 0.5 * path_length;
    light.lamps = lamps_at(ray, t_lamps, t_visibility, m, light.unshadowed_lamps) * optics.effective_length;
    light.unshadowed_lamps *= optics.effective_length;
#elif LAMPS == 2
    light.lamps = lamps_over_segment(ray, segment, light.unshadowed_lamps);
#endif
    return light;
}

vec3 sum_of(SegmentLight light) {
    vec3 gathered = light.diffuse;
#if HAS_SUN
    gathered += light.sun_visibility * light.sun;
#endif
#if LAMPS
    gathered += light.lamps;
#endif
    return gathered;
}

vec3 segment_light(Ray ray, Segment segment, Medium m, Optics optics, Ambient ambient, inout Extinction sun_front) {
    return sum_of(segment_light_parts(ray, segment, m, optics, ambient, sun_front));
}

#endif
