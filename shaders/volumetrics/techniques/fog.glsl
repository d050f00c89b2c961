// Light of the global media over a whole view ray in closed form: ambient light, emission and unshadowed suns.
// One homogeneous or one exponential height medium is one segment, and exact. No closed form is known for a mixture: it
// is cut into segments.
#ifndef VOLUMETRICS_FOG_GLSL
#define VOLUMETRICS_FOG_GLSL

#include "shaders/volumetrics/light/segment.glsl"

struct ClosedFormFog {
    vec3 glow;  // ambient light, emission and further suns
    vec3 sun;
    Extinction transmittance;
};

// What the medium scatters and emits over a length, for light of any strength: the coefficients are multiplied by the length
// first, which keeps them finite in the densest media.
vec3 glow_over(Medium m, Extinction effective_length, vec3 ambient) {
    return m.sigma_s * effective_length * ambient + m.emission * effective_length;
}

#if HAS_SUN
vec3 sun_over(Ray ray, Medium m, Extinction effective_length) {
    m.sigma_s *= effective_length;
    m.sigma_s_rayleigh *= effective_length;
    return sun_scattering(ray, m, Extinction(1.0));
}
#endif

void add_segment(Ray ray, float begin, float end, vec3 ambient, inout Extinction sun_front, inout ClosedFormFog fog) {
    Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, end - begin);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Optics optics = medium_optics(m, end - begin);
    fog.glow += fog.transmittance * glow_over(m, optics.effective_length, ambient);
#if HAS_SUN
    if (volumetrics.further_suns > 0u) fog.glow += fog.transmittance * further_suns(ray, begin, end);
    SunSegment sun = sun_segment(ray, begin, end, optics, sun_front);
    fog.sun += fog.transmittance * sun_over(ray, m, sun.effective_length);
#endif
    fog.transmittance *= optics.transmittance;
}

ClosedFormFog fog_in_parts(Ray ray, float end, Cuts cuts, int parts, vec3 ambient) {
    ClosedFormFog fog = ClosedFormFog(vec3(0.0), vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
#endif
    float begin = 0.0;
    for (int k = 1; k <= parts; ++k) {
        float cut = cuts.first * (pow(1.0 + cuts.end / cuts.first, float(k) / float(parts)) - 1.0);
        cut = clamp(cut, begin, cuts.end);
        add_segment(ray, begin, cut, ambient, sun_front, fog);
        begin = cut;
    }
    add_segment(ray, begin, end, ambient, sun_front, fog);
    return fog;
}

// The error of parts falls as the square of their length (Richardson): half as long, they have a third of what they differ.
// More than a few percent is no such error, and to add it might make energy.
vec3 extrapolated(vec3 coarse, vec3 fine) { return fine + clamp((fine - coarse) / 3.0, -0.03 * fine, 0.03 * fine); }

// surface: distance, m; endless: there is none, and `surface` only stands for far away.
// A mixture's error is in docs/techniques.md.
ClosedFormFog fog_over_ray(Ray ray, float surface, bool endless, vec3 ambient) {
    const int PARTS = 6;
    float end = visible_end(ray.origin.y, ray.direction.y, surface);
    Cuts cuts = find_cuts(ray.origin.y, ray.direction.y, end);
    ClosedFormFog fog = fog_in_parts(ray, end, cuts, cuts.needed ? 2 * PARTS : 0, ambient);
    if (cuts.needed) {
        ClosedFormFog coarse = fog_in_parts(ray, end, cuts, PARTS, ambient);
        fog.glow = extrapolated(coarse.glow, fog.glow);
        fog.sun = extrapolated(coarse.sun, fog.sun);
    }
    if (endless || end < surface) {
        vec3 depth = height_optical_depth(ray.origin.y, ray.direction.y, surface) +
                     volumetrics.homogeneous_sigma_t.rgb * (endless ? MAX_OPTICAL_DEPTH : surface);
        fog.transmittance = exp(-to_extinction(depth));
    }
    return fog;
}

#endif
