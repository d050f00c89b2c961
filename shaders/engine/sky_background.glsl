// What is seen behind the scene: the clear sky, before it high clouds in streaks, and the sun's disc. In the subset of
// GLSL that C++ compiles too (shaders/lib/glm_subset.h).
#ifndef ENGINE_SKY_BACKGROUND_GLSL
#define ENGINE_SKY_BACKGROUND_GLSL

#include "shaders/engine/sky_model.glsl"

const float SKY_SUN_RADIUS = 0.00465f;  // rad; half of 0.533 degrees
const float SKY_CLOUD_HEIGHT = 7.0f;    // km
const float SKY_BRIGHTEST = 60000.0f;   // in units of light; half floats and the tonemap need no more

float sky_lattice(ivec2 p) {
    uint h = uint(p.x) * 0x9e3779b9u ^ uint(p.y) * 0x85ebca6bu;
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    return float((h ^ (h >> 15u)) >> 8u) / 16777216.0f;
}

float sky_value_noise(vec2 p) {
    ivec2 i = ivec2(floor(p));
    vec2 f = p - floor(p);
    f = f * f * (3.0f - 2.0f * f);
    return mix(mix(sky_lattice(i), sky_lattice(i + ivec2(1, 0)), f.x),
               mix(sky_lattice(i + ivec2(0, 1)), sky_lattice(i + ivec2(1, 1)), f.x), f.y);
}

// Opacity of cirrus where a ray that rises by d.y > 0 meets a flat layer: noise drawn out along the wind.
float sky_cirrus(vec3 d) {
    vec2 p = vec2(d.x, d.z) * (SKY_CLOUD_HEIGHT / (d.y + 0.06f));
    vec2 along = vec2(0.86f, 0.51f);
    p = vec2(dot(p, along) * 0.045f, dot(p, vec2(-along.y, along.x)) * 0.17f);
    p.y += 0.7f * sky_value_noise(p * 0.6f + 3.0f);
    float sum = 0.0f;
    float weight = 0.5f;
    for (int octave = 0; octave < 4; ++octave) {
        sum += weight * sky_value_noise(p);
        p = mat2(1.6f, 1.2f, -1.2f, 1.6f) * p + 11.0f;
        weight *= 0.5f;
    }
    float streaks = smoothstep(0.46f, 0.85f, sum);
    // Thin overhead, and lost in the haze at the horizon.
    return 0.75f * streaks * smoothstep(0.015f, 0.12f, d.y) * (1.0f - 0.6f * d.y);
}

// `clear` with the clouds before it: lit by the sun at their height, with a forward lobe around the sun, and by the sky
// behind and above. `illuminance` of the sun in lux.
vec3 sky_clouded(vec3 clear, vec3 d, vec3 to_sun, float illuminance) {
    if (d.y <= 0.0f) {
        return clear;
    }
    float forward = max(dot(d, to_sun), 0.0f);
    vec3 sunlight = sky_transmittance(SKY_GROUND + SKY_CLOUD_HEIGHT, to_sun.y) *
                    sky_extraterrestrial(illuminance, to_sun.y);
    vec3 cloud = sunlight * (0.055f + 0.16f * pow(forward, 12.0f)) + 0.55f * clear;
    return mix(clear, cloud, sky_cirrus(d));
}

// Distance from the sun's centre in radii of its disc.
float sky_from_sun(vec3 d, vec3 to_sun) {
    return length(d - to_sun) / SKY_SUN_RADIUS;
}

// Radiance of the disc: the illuminance over the solid angle, darkened to the limb (1 - 0.6 (1 - cos)), which takes a
// fifth off the mean. 0 outside, over an edge `edge` radii wide, and below the horizon.
vec3 sky_sun_disc(vec3 d, vec3 to_sun, vec3 illuminance, float edge) {
    float from_center = sky_from_sun(d, to_sun);
    float disc = clamp((1.0f - from_center) / edge + 0.5f, 0.0f, 1.0f) * step(0.0f, d.y);
    float limb = 0.4f + 0.6f * sqrt(max(1.0f - from_center * from_center, 0.0f));
    return disc * illuminance * (limb / (0.8f * SKY_PI * SKY_SUN_RADIUS * SKY_SUN_RADIUS));
}

#endif
