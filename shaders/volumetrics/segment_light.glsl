// Radiance that a segment of a view ray sends to its front.
#ifndef VOLUMETRICS_SEGMENT_LIGHT_GLSL
#define VOLUMETRICS_SEGMENT_LIGHT_GLSL

#include "shaders/interface/shadows.glsl"
#include "shaders/volumetrics/lamps.glsl"
#include "shaders/volumetrics/segment.glsl"

// segment.offset: 0..1, where the segment is sampled, see below. `m` and `optics`: its medium. sun_front: the optical
// depth towards the sun at the segment's begin; becomes that at its end.
vec3 segment_light(Ray ray, Segment segment, Medium m, Optics optics, vec3 ambient, inout Extinction sun_front) {
    float path_length = segment.end - segment.begin;
    vec3 gathered = (m.sigma_s * ambient + m.emission) * optics.effective_length;

#if HAS_SUN
    // Visibility is sampled where that share of the light has been gathered.
    SunSegment sun = sun_segment(ray, segment.begin, segment.end, optics, sun_front);
    float t = segment.begin + path_length * equal_transmittance(segment.offset, sun.x);
    count_work(WORK_SHADOW_LOOKUPS, 1u);
    float visible = sun_visibility(ray.origin + ray.direction * t, t * ray.forward_cosine);
    gathered += visible * sun_scattering(ray, m, sun.effective_length);
#endif

#if LAMPS == 1
    gathered += lamps_at(ray, segment.begin + segment.offset * path_length, m.anisotropy) * m.sigma_s *
                optics.effective_length;
#elif LAMPS == 2
    gathered += lamps_over_segment(ray, segment);
#endif
    return gathered;
}

#endif
