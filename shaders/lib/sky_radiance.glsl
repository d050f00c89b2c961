#ifndef TYNDALL_LIB_SKY_RADIANCE
#define TYNDALL_LIB_SKY_RADIANCE

#include "shaders/lib/phase.glsl"

// Light of the sky as it arrives at a point: spherical harmonics of the bands 0 and 1, for each channel its mean over the
// sphere and three times the mean of radiance times direction. To first order the radiance from the unit direction w is
// mean + dot(slope, w).
struct SkyRadiance {
    vec3 mean;
    vec3 slope_r;
    vec3 slope_g;
    vec3 slope_b;
};

vec3 sky_slope(SkyRadiance sky, vec3 w) {
    return vec3(dot(sky.slope_r, w), dot(sky.slope_g, w), dot(sky.slope_b, w));
}

// The bands beyond are taken to be those of a cap of uniform light with the same bands 0 and 1: the small cap of a window, the
// half sphere of an open sky. xyz its axis; w the length of its mean direction, 1 for a point of light, 1/2 for a half sphere.
vec4 sky_cap(SkyRadiance sky) {
    vec3 slope = sky.slope_r + sky.slope_g + sky.slope_b;
    float size = sqrt(dot(slope, slope));
    float mean = sky.mean.x + sky.mean.y + sky.mean.z;
    return vec4(slope / max(size, 1.0e-30f), clamp(size / max(3.0f * mean, 1.0e-30f), 0.0f, 1.0f));
}

// Irradiance / pi of a surface with this normal. Of the clamped cosine / pi the bands 0, 1, 2 are scaled by 1, 2/3, 1/4. A cap with
// the mean direction r has of band 2 the part r (2 r - 1) of what a point of light has.
vec3 sky_irradiance(SkyRadiance sky, vec3 normal) {
    vec4 cap = sky_cap(sky);
    float c = dot(vec3(cap.x, cap.y, cap.z), normal);
    float band_2 = 5.0f * cap.w * max(2.0f * cap.w - 1.0f, 0.0f) * (1.5f * c * c - 0.5f);
    return max(sky.mean * (1.0f + 0.25f * band_2) + sky_slope(sky, normal) * (2.0f / 3.0f), vec3(0.0f));
}

// Radiance that a medium with the phase function of Henyey and Greenstein scatters towards the eye per sigma_s: the mean over the sphere of
// radiance times 4 pi p. `direction` is the view ray's: light from where it goes to is scattered forward. Band l is
// scaled by g^l. For a cap with the mean direction r > 1/2 what lies beyond band 1 is that of r / (2 r - 1) times a
// Henyey-Greenstein lobe of anisotropy g (2 r - 1): exact in bands 1 and 2, and whole for a point of light.
vec3 sky_scattered(SkyRadiance sky, vec3 direction, float g) {
    vec4 cap = sky_cap(sky);
    float c = dot(vec3(cap.x, cap.y, cap.z), direction);
    float narrow = max(2.0f * cap.w - 1.0f, 0.0f);
    float lobe_g = g * narrow;
    float beyond = cap.w / max(narrow, 1.0e-2f) *
                   (4.0f * PI * phase_henyey_greenstein(lobe_g, c) - 1.0f - 3.0f * lobe_g * c);
    return max(sky.mean * (1.0f + beyond) + sky_slope(sky, direction) * g, vec3(0.0f));
}

#endif
