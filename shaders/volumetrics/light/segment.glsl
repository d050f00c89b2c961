// A segment of the march apart from what is sampled: its medium's optics, the sun over it, and the tail behind the march.
#ifndef VOLUMETRICS_SEGMENT_GLSL
#define VOLUMETRICS_SEGMENT_GLSL

#include "shaders/interface/lights.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/light/ambient.glsl"
#include "shaders/volumetrics/media/extinction.glsl"
#include "shaders/volumetrics/light/light_transmittance.glsl"
#include "shaders/volumetrics/light/mixture.glsl"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/media/scattering.glsl"

// 1: global media have no other light.
#ifndef SUN_ALONE
#define SUN_ALONE 0
#endif

struct March {
    vec3 radiance;
    Extinction transmittance;
};

struct Optics {
    Extinction depth;
    Extinction transmittance;
    Extinction effective_length;  // int T dt over the segment, m
};

Optics medium_optics(Medium m, float path_length) {
    Optics optics;
    optics.depth = to_extinction(m.optical_depth);
    optics.transmittance = exp(-optics.depth);
    optics.effective_length = path_length * mean_transmittance(optics.depth, optics.transmittance);
    return optics;
}

#if HAS_SUN
// The sun over a segment, unshadowed. Along the ray both the optical depth from the segment's front and that towards the
// sun are affine in the density of a height medium, so the sum of the two is taken to run linearly from the front,
// where it is `front`, to front + x: exact for one height medium, and for homogeneous media.
struct SunSegment {
    float x;
    Extinction effective_length;  // int exp(-sum) dt, m
};

SunSegment sun_between(Extinction depth, Extinction front, Extinction back, float path_length) {
    Extinction x = depth + back - front;
    Extinction low = min(front, depth + back);
    Extinction size = abs(x);
    SunSegment s;
    s.x = average(x);
    s.effective_length = path_length * exp(-low) * mean_transmittance(size, exp(-size));
    return s;
}

// `front`: the optical depth towards the sun at a; becomes that at b.
SunSegment sun_segment(Ray ray, float a, float b, Optics optics, inout Extinction front) {
#if HEIGHT_MEDIA
    Extinction back = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * b, -sun_direction()));
    SunSegment sun = sun_between(optics.depth, front, back, b - a);
    front = back;
    return sun;
#else
    return SunSegment(average(optics.depth), optics.effective_length);
#endif
}

vec3 sun_scattering(Ray ray, Medium m, Extinction effective_length) {
    return sun_illuminance() * volume_scattering(m, -dot(sun_direction(), ray.direction)) * effective_length;
}
#endif

// Light of global media under ambient light and an unshadowed sun over [begin, end]. sun_front: the optical depth
// towards the sun at `begin`; becomes that at `end`.
void add_global(Ray ray, float begin, float end, Ambient ambient, inout Extinction sun_front, inout March march) {
    Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, end - begin);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Optics optics = medium_optics(m, end - begin);
    vec3 gathered = vec3(0.0);
#if !SUN_ALONE
    gathered = ambient_glow(m, ambient) * optics.effective_length;
#endif
#if HAS_SUN
    SunSegment sun = sun_segment(ray, begin, end, optics, sun_front);
    gathered += sun_scattering(ray, m, sun.effective_length);
#endif
    march.radiance += march.transmittance * gathered;
    march.transmittance *= optics.transmittance;
}

#if HAS_SUN
struct FurtherSun {
    vec3 to_sun;
    vec3 illuminance;
};

FurtherSun further_sun(uint i) {
    GpuLight light = light_at(i);
    return FurtherSun(-light.direction_type.xyz,
                      light.intensity_radius.rgb / (SUN_LAMP_DISTANCE * SUN_LAMP_DISTANCE));
}

// What the further suns, the first of the lamps, send from global media over [begin, end] to its front, unshadowed.
vec3 further_suns(Ray ray, float begin, float end) {
    float y = ray.origin.y + ray.direction.y * begin;
    Medium m = global_medium(y, ray.direction.y, end - begin);
    Optics optics = medium_optics(m, end - begin);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < volumetrics.further_suns; ++i) {
        FurtherSun sun = further_sun(i);
        Extinction front = to_extinction(sun_optical_depth(y, sun.to_sun));
        Extinction back = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * end, sun.to_sun));
        sum += sun.illuminance * volume_scattering(m, dot(sun.to_sun, ray.direction)) *
               sun_between(optics.depth, front, back, end - begin).effective_length;
    }
    return sum;
}
#endif

const int TAIL_PARTS = 6;  // of a mixture, up to where it ends or nothing more shows

// Global media between the end of the march and the surface, or without end where there is none. A mixture is cut as mixture.glsl
// says, what lies behind the cuts is one part more.
void march_tail(Ray ray, float begin, float end, bool endless, Ambient ambient, Extinction sun_front, inout March march) {
    Extinction before = march.transmittance;
    float y = ray.origin.y + ray.direction.y * begin;
    float seen = visible_end(y, ray.direction.y, end - begin);
    Cuts cuts = find_cuts(y, ray.direction.y, seen);
    float growth = pow(1.0 + cuts.end / cuts.first, 1.0 / float(TAIL_PARTS));
    float part_length = cuts.first * (growth - 1.0);
    float a = 0.0;
    for (int k = cuts.needed ? 0 : TAIL_PARTS; k <= TAIL_PARTS; ++k) {
        float b = k == TAIL_PARTS ? seen : min(a + part_length, cuts.end);
#if HAS_SUN
        march.radiance += march.transmittance * further_suns(ray, begin + a, begin + b);
#endif
        add_global(ray, begin + a, begin + b, ambient, sun_front, march);
        a = b;
        part_length *= growth;
    }
    vec3 depth = height_optical_depth(ray.origin.y + ray.direction.y * begin, ray.direction.y, end - begin) +
                 volumetrics.homogeneous_sigma_t.rgb * (endless ? MAX_OPTICAL_DEPTH : end - begin);
    march.transmittance = before * exp(-to_extinction(depth));
}

#endif
