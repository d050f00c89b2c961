#ifndef TYNDALL_LIB_MEDIA_SHAPE
#define TYNDALL_LIB_MEDIA_SHAPE

#include "shaders/lib/noise.glsl"
#include "shaders/lib/transmittance.glsl"

// Density of a bounded medium: shape * noise * height. Points p are in metres in the frame of the shape: relative
// to its centre and turned by the inverse of its rotation, not scaled.

const int MEDIA_SPHERE = 0;
const int MEDIA_ELLIPSOID = 1;
const int MEDIA_BOX = 2;

// Density from the depth below the surface [m]: 0 at the rim, 1 from softness metres inside; a step if that is 0.
float soft_rim(float depth, float softness) {
    return clamp(depth / max(softness, 1.0e-6f), 0.0f, 1.0f);
}

float sphere_density(vec3 p, float radius, float softness) {
    return soft_rim(radius - length(p), softness);
}

// The depth is taken along the gradient of k(p) = |p / radii|: (1 - k) / |grad k|, at most the smallest radius. It
// is exact at the rim, on the axes and for a sphere; elsewhere it is too large, by less than 2.5% for axes in the
// ratio 1.5, 6% for 2 and 21% for 4 down to a depth of a quarter of the smallest radius, so the ramp is that much
// steeper.
float ellipsoid_density(vec3 p, vec3 radii, float softness) {
    vec3 q = p / radii;
    float k = length(q);
    float gradient = length(q / radii) / max(k, 1.0e-6f);
    float smallest = min(radii.x, min(radii.y, radii.z));
    return soft_rim(min((1.0f - k) / max(gradient, 1.0e-6f / smallest), smallest), softness);
}

// The depth below the nearest face.
float box_density(vec3 p, vec3 half_size, float softness) {
    vec3 depth = half_size - abs(p);
    return soft_rim(min(depth.x, min(depth.y, depth.z)), softness);
}

// extent: radius in x, radii, or half the size.
float media_shape_density(int shape, vec3 p, vec3 extent, float softness) {
    if (shape == MEDIA_SPHERE) {
        return sphere_density(p, extent.x, softness);
    }
    if (shape == MEDIA_ELLIPSOID) {
        return ellipsoid_density(p, extent, softness);
    }
    return box_density(p, extent, softness);
}

const int MEDIA_NOISE_OCTAVES = 4;
const float MEDIA_NOISE_CONTRAST = 3.0f;

// Factor in [0, 2] with mean 1, so that amount (0..1) changes the contrast of a medium and not how much of it there
// is:
//     mix(1, 2 clamp(0.5 + contrast (fbm - 0.5), 0, 1), amount)
// scale > 0 is the size in metres of the largest features; the noise is fixed to the shape. amount 0 costs nothing.
float media_noise(vec3 p, float scale, float amount, uint seed) {
    if (amount <= 0.0f) {
        return 1.0f;
    }
    float centred = fbm_noise(p / scale, MEDIA_NOISE_OCTAVES, seed) - 0.5f;
    return mix(1.0f, 2.0f * clamp(0.5f + MEDIA_NOISE_CONTRAST * centred, 0.0f, 1.0f), amount);
}

// Factor of an exponential height inside a shape, by the height y of the point in the world; falloff <= 0: none.
float media_height(float y, float base, float falloff) {
    return falloff > 0.0f ? height_density(y, base, falloff) : 1.0f;
}

#endif
