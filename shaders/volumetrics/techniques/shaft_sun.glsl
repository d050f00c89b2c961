// Light of the sun scattered towards the eye between it and a point of the ray, unshadowed: what each face of the lit
// volume adds or takes away. Needs HAS_SUN 1 for sun_light_to.
#ifndef VOLUMETRICS_SHAFT_SUN_GLSL
#define VOLUMETRICS_SHAFT_SUN_GLSL

#include "shaders/volumetrics/light/segment.glsl"

// The closed form holds from the eye to any distance in homogeneous media, and in one height medium. In a mixture the ray
// is cut at y (exp(k z) - 1) metres, k = 1 .. x - 1, the same for all faces of a pixel, so that what they take from each
// other is exact; w: what lies behind cannot be seen.
uniform vec4 shaft_cuts;

float shaft_cut(int k, float t) {
    return k == int(shaft_cuts.x) ? t : min(t, shaft_cuts.y * (exp(float(k) * shaft_cuts.z) - 1.0));
}

#if HAS_SUN
// int_0^t T(0, s) sigma_s p T_sun E ds
vec3 sun_light_to(Ray ray, float t) {
    float end = min(t, shaft_cuts.w);
    vec3 sum = vec3(0.0);
    Extinction transmittance = Extinction(1.0);
    Extinction front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
    float a = 0.0;
    for (int k = 1; a < end; ++k) {
        float b = shaft_cut(k, end);
        Medium m = global_medium(ray.origin.y + ray.direction.y * a, ray.direction.y, b - a);
        count_work(WORK_MEDIUM_SAMPLES, 1u);
        Optics optics = medium_optics(m, b - a);
        SunSegment sun = sun_segment(ray, a, b, optics, front);
        sum += transmittance * sun_scattering(ray, m, sun.effective_length);
        transmittance *= optics.transmittance;
        a = b;
    }
    return sum;
}
#endif

#endif
