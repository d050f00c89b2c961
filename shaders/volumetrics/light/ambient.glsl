// Ambient light of a part of a view ray, and what media scatter of it to the eye: the same everywhere and from all sides; or, with
// SKY_VISIBILITY, what a host says of each place (ambient_radiance_at).
#ifndef VOLUMETRICS_AMBIENT_GLSL
#define VOLUMETRICS_AMBIENT_GLSL

#include "shaders/interface/lights.glsl"
#include "shaders/lib/sky_radiance.glsl"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/media/scattering.glsl"

// 1: there is no other light, and media do not shine.
#ifndef SKY_ALONE
#define SKY_ALONE 0
#endif

#if SKY_VISIBILITY
struct Ambient {
    SkyRadiance sky;
    vec3 direction;  // of the view ray
};

// At a distance along the ray, m.
Ambient ambient_at(Ray ray, float t) {
    return Ambient(ambient_radiance_at(ray.origin + ray.direction * t), ray.direction);
}

// Each lobe of the media's phase function is taken for that of Henyey and Greenstein with the same mean cosine. Rayleigh's is
// all but isotropic to light as smooth as this.
vec3 ambient_scattering(Medium m, Ambient ambient) {
    int kind = int(volumetrics.phase);
    bool two_lobes = kind == PHASE_DOUBLE_HENYEY_GREENSTEIN || kind == PHASE_HG_DRAINE;
    float g = kind == PHASE_HG_DRAINE ? volumetrics.droplet_anisotropy : m.anisotropy;
    vec3 light = sky_scattered(ambient.sky, ambient.direction, two_lobes ? g : phase_mean_cosine(kind, g));
    if (two_lobes) {
        float second_g = phase_mean_cosine_draine(volumetrics.second_anisotropy, volumetrics.second_alpha);
        light = mix(light, sky_scattered(ambient.sky, ambient.direction, second_g), volumetrics.second_weight);
    }
    vec3 sum = particle_sigma_s(m) * light;
#if RAYLEIGH
    sum += m.sigma_s_rayleigh * ambient.sky.mean;
#endif
    return sum;
}
#else
#define Ambient vec3

vec3 ambient_scattering(Medium m, vec3 ambient) { return m.sigma_s * ambient; }
#endif

// Radiance per metre that the medium adds without sun and lamps.
vec3 ambient_glow(Medium m, Ambient ambient) {
#if SKY_ALONE
    return ambient_scattering(m, ambient);
#else
    return ambient_scattering(m, ambient) + m.emission;
#endif
}

#endif
