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

// sigma_t at a height.
vec3 global_sigma_t(float y) { return global_medium(y, 0.0, 1.0).optical_depth; }

// Nothing shows behind 1e6 mean free paths of the medium at the eye, nor where a falling ray has come 40 falloffs below
// the base. To go on would only cost precision.
float visible_end(Ray ray, float surface) {
    vec3 sigma_t = global_sigma_t(ray.origin.y);
    float end = min(surface, 1.0e6 / max(max(sigma_t.r, max(sigma_t.g, sigma_t.b)), 1.0e-30));
#if HEIGHT_MEDIA
    if (ray.direction.y < 0.0)
        for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
            float falloff = volumetrics.height[i].sigma_t_falloff.w;
            float fall = max(ray.origin.y - volumetrics.height[i].sigma_s_base.w + 40.0 * falloff, falloff);
            end = min(end, fall / max(-ray.direction.y, 1.0e-6));
        }
#endif
    return end;
}

// A mixture is cut at first ((1 + end / first)^(k / n) - 1), k = 1 .. n: densely at the eye, and evenly within `first`, on
// which none of its media changes by more than e^2, or at the eye is more than THICK mean free paths of its densest channel.
// Behind `end` nothing shows, or no medium but the homogeneous is left.
struct Cuts {
    bool needed;
    float first;  // m
    float end;
};

Cuts find_cuts(Ray ray, float end) {
    Cuts cuts = Cuts(false, end, end);
#if HEIGHT_MEDIA
    const float OPAQUE = 16.0;
    const float THICK = 4.0;
    vec3 homogeneous = volumetrics.homogeneous_sigma_t.rgb + volumetrics.homogeneous_emission.rgb;
    cuts.needed = HEIGHT_COUNT > 1u || (HEIGHT_COUNT == 1u && homogeneous != vec3(0.0));
    float thickest = 0.0;
    cuts.first = 1.0e30;
    cuts.end = min(end, OPAQUE / max(smallest(to_extinction(volumetrics.homogeneous_sigma_t.rgb)), 1.0e-30));
    for (uint i = 0u; cuts.needed && i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        float scale = medium.sigma_t_falloff.w / max(abs(ray.direction.y), 1.0e-6);  // m, on which it changes by e
        cuts.first = min(cuts.first, 2.0 * scale);
        float sigma_t = largest(to_extinction(medium.sigma_t_falloff.rgb)) *
                        height_density(ray.origin.y, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
        cuts.first = min(cuts.first, THICK / max(sigma_t, 1.0e-30));
        thickest = max(thickest, scale);
        // Its depth is sigma scale (exp(t / scale) - 1) where the ray falls, sigma scale (1 - exp(-t / scale)) where it
        // rises, sigma at the eye; x = log(OPAQUE / (sigma scale)), for sigma may be far below what a float can hold.
        float x = log(OPAQUE / max(smallest(to_extinction(medium.sigma_t_falloff.rgb)) * scale, 1.0e-30)) +
                  (ray.origin.y - medium.sigma_s_base.w) / medium.sigma_t_falloff.w;
        if (ray.direction.y < 0.0)
            cuts.end = min(cuts.end, scale * (max(x, 0.0) + log(1.0 + exp(-abs(x)))));
        else if (x < 0.0)
            cuts.end = min(cuts.end, scale * -log(max(1.0 - exp(x), 1.0e-6)));
    }
    if (ray.direction.y >= 0.0) cuts.end = min(cuts.end, OPAQUE * thickest);
#endif
    return cuts;
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
    float end = visible_end(ray, surface);
    Cuts cuts = find_cuts(ray, end);
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
