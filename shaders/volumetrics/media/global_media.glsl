// The media that fill space, in closed form. HEIGHT_MEDIA: 0 or 1 exponential height medium, or any number up to
// MAX_HEIGHT_MEDIA; one is by far the most usual, and without a loop several times faster than with it. Programs that
// ask for their optical depth a few times a pixel do not tell, and have the loop.
#ifndef VOLUMETRICS_GLOBAL_MEDIA_GLSL
#define VOLUMETRICS_GLOBAL_MEDIA_GLSL

#include "shaders/lib/transmittance.glsl"
#include "shaders/volumetrics/frame/data.glsl"

#ifndef HEIGHT_MEDIA
#define HEIGHT_MEDIA MAX_HEIGHT_MEDIA
#endif
// RAYLEIGH 0: no medium has Rayleigh's phase function, as none may where extinction is not coloured; it is no axis of its
// own, for it saves next to nothing.
#ifndef RAYLEIGH
#ifdef CHROMATIC
#define RAYLEIGH CHROMATIC
#else
#define RAYLEIGH 1
#endif
#endif
#define HEIGHT_COUNT (HEIGHT_MEDIA == 1 ? 1u : volumetrics.height_media_count)

// Keeps sums and products of optical depths finite; exp(-x) is 0 long before.
const float MAX_OPTICAL_DEPTH = 1.0e30f;

// A medium over a segment of a straight line: means over the segment, and its optical depth.
struct Medium {
    vec3 sigma_s;           // 1/m
    float anisotropy;       // weighted by scattering, Rayleigh's left out
    vec3 emission;          // radiance per metre
    vec3 optical_depth;
    vec3 sigma_s_rayleigh;  // 1/m: the part of sigma_s with Rayleigh's phase function
};

float mean_channel(vec3 v) { return dot(v, vec3(1.0 / 3.0)); }

// Scattering that is not Rayleigh's.
vec3 particle_sigma_s(Medium m) {
#if RAYLEIGH
    return max(m.sigma_s - m.sigma_s_rayleigh, 0.0);
#else
    return m.sigma_s;
#endif
}

// Adds scattering by particles; `weighted`: sum of its anisotropy * mean sigma_s.
void add_particles(vec3 sigma_s, float weighted, inout Medium m) {
    weighted += m.anisotropy * mean_channel(particle_sigma_s(m));
    m.sigma_s += sigma_s;
    m.anisotropy = weighted / max(mean_channel(particle_sigma_s(m)), 1.0e-30);
}

float height_mean_density(HeightMedium medium, float y, float direction_y, float path_length) {
    return height_mean_density(y, direction_y, path_length, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
}

// From a point at height y over path_length metres in a direction with the vertical component direction_y.
Medium global_medium(float y, float direction_y, float path_length) {
    Medium m;
    m.sigma_s = volumetrics.homogeneous_sigma_s.rgb;
    m.emission = volumetrics.homogeneous_emission.rgb;
    m.optical_depth = volumetrics.homogeneous_sigma_t.rgb * path_length;
    m.anisotropy = volumetrics.homogeneous_sigma_s.w;
    m.sigma_s_rayleigh = vec3(0.0);
#if RAYLEIGH
    m.sigma_s_rayleigh = volumetrics.homogeneous_rayleigh.rgb;
#endif
#if HEIGHT_MEDIA
    float weighted = m.anisotropy * mean_channel(particle_sigma_s(m));
    for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        float density = height_mean_density(medium, y, direction_y, path_length);
        vec3 sigma_s = medium.sigma_s_base.rgb * density;
        m.sigma_s += sigma_s;
        m.emission += medium.emission_g.rgb * density;
        m.optical_depth += medium.sigma_t_falloff.rgb * (density * path_length);
        weighted += medium.emission_g.w * mean_channel(sigma_s);
#if RAYLEIGH
        m.sigma_s_rayleigh += medium.sigma_s_rayleigh.rgb * density;
#endif
    }
    m.optical_depth = min(m.optical_depth, MAX_OPTICAL_DEPTH);
    if (HEIGHT_COUNT > 0u) m.anisotropy = weighted / max(mean_channel(particle_sigma_s(m)), 1.0e-30);
#endif
    return m;
}

// The height media alone: optical depth as above, and scattering at a height.
vec3 height_optical_depth(float y, float direction_y, float path_length) {
    vec3 depth = vec3(0.0);
#if HEIGHT_MEDIA
    for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        depth += medium.sigma_t_falloff.rgb *
                 (height_mean_density(medium, y, direction_y, path_length) * path_length);
    }
#endif
    return min(depth, MAX_OPTICAL_DEPTH);
}

vec3 height_sigma_s(float y) {
    vec3 sigma_s = vec3(0.0);
#if HEIGHT_MEDIA
    for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        sigma_s += medium.sigma_s_base.rgb *
                   height_density(y, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
    }
#endif
    return sigma_s;
}

// Of all global media at a height: the part of their scattering with Rayleigh's phase function.
vec3 global_sigma_s_rayleigh(float y) {
    vec3 sigma_s = vec3(0.0);
#if RAYLEIGH
    sigma_s = volumetrics.homogeneous_rayleigh.rgb;
#if HEIGHT_MEDIA
    for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        sigma_s += medium.sigma_s_rayleigh.rgb *
                   height_density(y, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
    }
#endif
#endif
    return sigma_s;
}

// To infinity in a direction with the vertical component direction_y.
vec3 height_optical_depth_to_infinity(float y, float direction_y) {
    vec3 depth = vec3(0.0);
#if HEIGHT_MEDIA
    for (uint i = 0u; i < HEIGHT_COUNT; ++i) {
        HeightMedium medium = volumetrics.height[i];
        depth += medium.sigma_t_falloff.rgb *
                 height_density_length_to_infinity(y, direction_y, medium.sigma_s_base.w, medium.sigma_t_falloff.w);
    }
#endif
    return min(depth, MAX_OPTICAL_DEPTH);
}

#endif
