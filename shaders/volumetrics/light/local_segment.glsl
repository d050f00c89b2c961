// Light of a part of a view ray in which there are local media: see ray_media.glsl.
#ifndef VOLUMETRICS_LOCAL_SEGMENT_GLSL
#define VOLUMETRICS_LOCAL_SEGMENT_GLSL

#include "shaders/volumetrics/light/segment.glsl"
#include "shaders/volumetrics/media/ray_media.glsl"

#if HAS_SUN
Extinction local_sun_front = Extinction(0.0);  // optical depth of the local media between the sun and the place reached

Extinction local_sun_depth(Ray ray, float t) {
    return to_extinction(local_sun_optical_depth(ray.origin + ray.direction * t));
}

#if GRIDS
// What density grids scatter of sunlight that was scattered before, over a part of a ray in two halves, as its front sends it on:
// the order n + 1 as if light were scattered once, by 2^-n as much matter, dimmed by 2^-n of the optical depth and with an
// anisotropy of g 2^-n (Wrenninge et al. 2013, "Oz: The Great and Volumetric": a = b = c = 1/2). Not physics, but
// thick clouds are bright.
vec3 later_orders(Ray ray, Medium m, Extinction half_depth, Extinction front, Extinction middle, Extinction back, vec2 lengths) {
    vec3 sum = vec3(0.0);
    float part = 0.5;
    for (uint n = 1u; n < volumetrics.scattering_orders; ++n) {
        Extinction path = sun_between(half_depth, part * front, part * middle, lengths.x).effective_length +
                          exp(-half_depth) * sun_between(half_depth, part * middle, part * back, lengths.y).effective_length;
        sum += part * particle_phase(m.anisotropy, part, -dot(sun_direction(), ray.direction)) * path;
        part *= 0.5;
    }
    return sun_illuminance() * grid_sigma_s * sum;
}
vec3 sun_later_orders = vec3(0.0);  // of the last sun_part
#endif

// As sun_segment, through local media too: in two halves, for their shadow may lie anywhere in the part.
SunSegment sun_part(Ray ray, Medium m, float begin, float end, Optics optics, inout Extinction front) {
    float middle = 0.5 * (begin + end);
    Extinction half_depth = 0.5 * optics.depth;
    Extinction at_middle = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * middle, -sun_direction())) +
                           local_sun_depth(ray, middle);
    Extinction back = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * end, -sun_direction()));
    Extinction local_back = local_sun_depth(ray, end);
    SunSegment sun = sun_between(half_depth, front + local_sun_front, at_middle, middle - begin);
    SunSegment behind = sun_between(half_depth, at_middle, back + local_back, end - middle);
    sun.effective_length += exp(-half_depth) * behind.effective_length;
    sun.x += behind.x;
#if GRIDS
    sun_later_orders = later_orders(ray, m, half_depth, front + local_sun_front, at_middle, back + local_back,
                                    vec2(middle - begin, end - middle));
#endif
    front = back;
    local_sun_front = local_back;
    return sun;
}
#endif

// Local and global media over [begin, end] under ambient light and an unshadowed sun: behind the froxels there are neither lamps
// nor shadows. sun_front: as of add_global. The chords were found before.
void add_local_segments(Ray ray, float begin, float end, Ambient ambient, inout Extinction sun_front, inout March march) {
#if HAS_SUN
    local_sun_front = local_sun_depth(ray, begin);
#endif
    while (begin < end) {
        float part_end = next_cut(ray, begin, end, largest(march.transmittance));
        float path_length = part_end - begin;
        Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, path_length);
        count_work(WORK_MEDIUM_SAMPLES, 1u);
        add_local_media(ray, begin, part_end, m);
        Optics optics = medium_optics(m, path_length);
        vec3 gathered = ambient_glow(m, ambient) * optics.effective_length;
#if HAS_SUN
        gathered += sun_scattering(ray, m, sun_part(ray, m, begin, part_end, optics, sun_front).effective_length);
#if GRIDS
        gathered += sun_later_orders;
#endif
#endif
        march.radiance += march.transmittance * gathered;
        march.transmittance *= optics.transmittance;
        begin = part_end;
    }
}

#endif
