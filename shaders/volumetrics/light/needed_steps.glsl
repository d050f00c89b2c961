// How many segments a ray needs whose lights have no noise, so that nothing but the media asks for short ones: at most `steps`.
//
// A segment takes its light to be spread as one exponential, and its mean scattering, extinction and emission to stand for each of its points
// (segment.glsl). Both are exact where density is the same all along, and where it changes by f e-folds while x of optical depth on the way
// to the eye and to the sun is gained or lost, light is off or misplaced by about the covariance of two linear functions, f x / 12. n segments
// have f/n and x/n each. Channels share one spread, so that coloured extinction asks for segments of COLOURED_DEPTH between them. Local media cut the ray themselves (ray_media.glsl), and
// LEAST_LOCAL_STEPS cuts more are as many as dense ones need. The four nodes of a lamp's rule (lamp_segment.glsl) follow its light
// over LAMP_DEPTH of optical depth and e-folds of density.
#ifndef VOLUMETRICS_NEEDED_STEPS_GLSL
#define VOLUMETRICS_NEEDED_STEPS_GLSL

#include "shaders/volumetrics/light/segment.glsl"

// Of the light, that f x / (12 n^2) may be.
const float STEP_TOLERANCE = 0.001;

#if HEIGHT_MEDIA
// Scattering, extinction and emission of global media at two heights: the most e-folds that one of them changes by.
float most_folds(float y_a, float y_b) {
    Medium a = global_medium(y_a, 0.0, 1.0), b = global_medium(y_b, 0.0, 1.0);
    vec3 at_a = vec3(mean_channel(a.sigma_s), mean_channel(a.optical_depth), mean_channel(a.emission));
    vec3 at_b = vec3(mean_channel(b.sigma_s), mean_channel(b.optical_depth), mean_channel(b.emission));
    vec3 folds = abs(log(max(at_b, 1.0e-30) / max(at_a, 1.0e-30)));
    return max(folds.x, max(folds.y, folds.z));
}
#endif

const uint LEAST_LOCAL_STEPS = 4u;
const float COLOURED_DEPTH = 0.25;
const float LAMP_DEPTH = 2.0;

uint needed_steps(Ray ray, float begin, float end) {
    Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, end - begin);
    float x = mean_channel(m.optical_depth);
    uint least = 1u;
#if LOCAL_MEDIA == 2
    if (media_span.x < media_span.y) least = LAMPS > 0 ? volumetrics.steps : min(volumetrics.steps, LEAST_LOCAL_STEPS);
#endif
#if HEIGHT_MEDIA
    float a = ray.origin.y + ray.direction.y * begin;
    float b = ray.origin.y + ray.direction.y * end;
    float folds = most_folds(a, b);
#else
    const float folds = 0.0;
#endif
#if LAMPS
    least = max(least, uint(ceil(min((x + folds) / LAMP_DEPTH, 1.0e6))));
#endif
#if HEIGHT_MEDIA
#if HAS_SUN
    x += abs(mean_channel(sun_optical_depth(b, -sun_direction()) - sun_optical_depth(a, -sun_direction())));
#endif
    least = max(least, uint(ceil(sqrt(min(folds * x / (12.0 * STEP_TOLERANCE), 1.0e6)))));
#endif
#if CHROMATIC
    float coloured = largest(m.optical_depth) - smallest(m.optical_depth);
    least = max(least, uint(ceil(min(coloured / COLOURED_DEPTH, 1.0e6))));
#endif
    return min(least, volumetrics.steps);
}

// The length of the first of n segments, as a share of the ray, and each over the one before: of n as modules/volumetrics/src/media/media.cpp has it of
// `steps`, with the same last length over the first.
vec2 stepping_of(uint n) {
    float strength = log(volumetrics.step_growth) * (float(volumetrics.steps) - 1.0);
    if (n == 1u || strength < 1.0e-4) return vec2(1.0 / float(n), 1.0);
    float growth = strength / (float(n) - 1.0);
    return vec2((exp(growth) - 1.0) / (exp(growth * float(n)) - 1.0), exp(growth));
}

#endif
