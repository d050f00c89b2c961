// Light of the global media over a whole view ray in closed form: ambient light, emission and an unshadowed sun.
// One homogeneous or one exponential height medium is one segment, and exact. No closed form is known for a mixture: it
// is cut into at most seven segments.
#ifndef VOLUMETRICS_FOG_GLSL
#define VOLUMETRICS_FOG_GLSL

#include "shaders/volumetrics/light/segment.glsl"

struct ClosedFormFog {
    vec3 glow;  // ambient light and emission
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

// Where a mixture is cut: its densest height medium into four equal optical depths, of which all but the first 4 are left
// out, as nothing more shows, and its thin end where the density has changed by further 1, 2 and 4 powers of e.
// Against quadrature over 1500 random mixtures of one homogeneous and one height medium (0.0001 to 0.05 and 0.001 to 1 per
// metre, falloffs of 1 to 100 m): half are exact to 1e-4, 95% to 0.4%, 99% to 1.2%, all to 7%.
const int CUTS = 6;
struct Cuts {
    bool needed;
    float scale;    // m, on which the density changes by e
    float sigma_t;  // of that medium at the eye
    float depth;    // optical depth of what is cut
};

Cuts find_cuts(Ray ray, float end) {
    Cuts cuts = Cuts(false, 0.0, 0.0, 0.0);
#if HEIGHT_MEDIA
    vec3 homogeneous = volumetrics.homogeneous_sigma_t.rgb + volumetrics.homogeneous_emission.rgb;
    cuts.needed = HEIGHT_COUNT > 1u || (HEIGHT_COUNT == 1u && homogeneous != vec3(0.0));
    // A falling ray loses the light of a high sun too.
    float shown = 4.0;
#if HAS_SUN
    if (ray.direction.y < 0.0) shown /= 1.0 + ray.direction.y / min(sun_direction().y, -0.01);
#endif
    for (uint i = 0u; cuts.needed && i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        float falloff = medium.sigma_t_falloff.w;
        float sigma_t = mean_channel(medium.sigma_t_falloff.rgb);
        float at_eye = sigma_t * height_density(ray.origin.y, medium.sigma_s_base.w, falloff);
        if (at_eye < cuts.sigma_t) continue;
        cuts.scale = falloff / max(abs(ray.direction.y), 1.0e-6);
        cuts.sigma_t = at_eye;
        cuts.depth = min(sigma_t * height_mean_density(medium, ray.origin.y, ray.direction.y, end) * end, shown);
    }
#endif
    return cuts;
}

// Where the medium that is cut has an optical depth: t = +-l ln(1 +- depth / (sigma_t l)).
float distance_at(Cuts cuts, float depth, bool falling) {
    float q = min(depth / max(cuts.sigma_t * cuts.scale, 1.0e-30), 1.0e30) * (falling ? 1.0 : -1.0);
    float log_q = abs(q) < 1.0e-3 ? q - 0.5 * q * q : log(max(1.0 + q, 1.0e-30));
    return cuts.scale * abs(log_q);
}

float cut_at(Cuts cuts, int i, bool falling) {
    if (falling) {
        if (i >= 3) return distance_at(cuts, cuts.depth * float(i - 2) * 0.25, true);
        return distance_at(cuts, cuts.depth * 0.25, true) - cuts.scale * exp2(float(2 - i));
    }
    if (i < 3) return distance_at(cuts, cuts.depth * float(i + 1) * 0.25, false);
    return distance_at(cuts, cuts.depth * 0.75, false) + cuts.scale * exp2(float(i - 3));
}

// surface: distance, m; endless: there is none, and `surface` only stands for far away.
ClosedFormFog fog_over_ray(Ray ray, float surface, bool endless, vec3 ambient) {
    ClosedFormFog fog = ClosedFormFog(vec3(0.0), vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
#endif
    float end = visible_end(ray, surface);
    float begin = 0.0;
    Cuts cuts = find_cuts(ray, end);
    for (int i = 0; cuts.needed && i < CUTS; ++i) {
        float cut = cut_at(cuts, i, ray.direction.y < 0.0);
        if (cut <= begin || cut >= end) continue;
        add_segment(ray, begin, cut, ambient, sun_front, fog);
        begin = cut;
    }
    add_segment(ray, begin, end, ambient, sun_front, fog);
    if (endless || end < surface) {
        vec3 depth = height_optical_depth(ray.origin.y, ray.direction.y, surface) +
                     volumetrics.homogeneous_sigma_t.rgb * (endless ? MAX_OPTICAL_DEPTH : surface);
        fog.transmittance = exp(-to_extinction(depth));
    }
    return fog;
}

#endif
