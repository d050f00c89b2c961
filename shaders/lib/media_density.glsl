#ifndef TYNDALL_LIB_MEDIA_DENSITY
#define TYNDALL_LIB_MEDIA_DENSITY

#include "shaders/lib/noise.glsl"
#include "shaders/lib/transmittance.glsl"

// Factors of a bounded medium's density: rim * noise * height. Points p are in metres in the frame of the shape, see
// shaders/volumetrics/media/shape.glsl.

// Density from the depth below the surface [m]: 0 at the rim, 1 from softness metres inside; a step if that is 0.
float soft_rim(float depth, float softness) {
    return clamp(depth / max(softness, 1.0e-6f), 0.0f, 1.0f);
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
