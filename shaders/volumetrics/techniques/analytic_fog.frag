// Fog from depth alone, without a march. All modes scatter the suns by the media's phase function (the sun lobe), ambient
// light and emission, and know coloured extinction. With S = sigma_s (sum p E_sun + L_ambient) + emission and sigma_t:
//     FOG_HEIGHT       the exact integral with the media's height profiles, see fog.glsl
//     the others       the media as they are at the eye's height, everywhere; light = S / sigma_t (1 - T(d)), where
//     FOG_EXPONENTIAL  T(d) = exp(-sigma_t d)               (GL_EXP), exact for homogeneous media
//     FOG_SQUARED      T(d) = exp(-(sigma_t d)^2 / ln 2)    (GL_EXP2)
//     FOG_LINEAR       T(d) = max(1 - sigma_t d / (2 ln 2), 0)    (GL_LINEAR from the eye to d = 2 ln 2 / sigma_t)
// All three are 1 at the eye and 1/2 at d = ln 2 / sigma_t, so that one density suits them all. d is the distance along
// the ray, not the view depth: fog does not move when the camera turns.
// It cannot: shadows (no shaft, and sun in closed rooms), lamps, local media, light that a wall keeps out. A medium that
// only emits, with sigma_t = 0, does not show in FOG_SQUARED. Inside the medium and at any depth, it is as valid as outside.
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/techniques/fog.glsl"

layout(binding = 0) uniform sampler2D depth_texture;

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

const float LN2 = 0.693147181;

// T of the modes above, and int of T's counterpart over the ray: (1 - T) / sigma_t, m.
struct Curve {
    Extinction transmittance;
    Extinction effective_length;
};

Curve fog_curve(int mode, Extinction sigma_t, float surface, bool endless) {
    // Behind 1e4 mean free paths nothing shows; up to there no square overflows.
    Extinction d = min(Extinction(surface), 1.0e4 / max(sigma_t, 1.0e-30));
    Extinction x = sigma_t * d;
    Curve curve;
    if (mode == FOG_LINEAR) {
        curve.transmittance = max(1.0 - x / (2.0 * LN2), 0.0);
        curve.effective_length = d * min(Extinction(1.0 / (2.0 * LN2)), 1.0 / max(x, 1.0e-30));
    } else {
        Extinction y = mode == FOG_SQUARED ? x * x / LN2 : x;
        curve.transmittance = exp(-y);
        curve.effective_length = d * mean_transmittance(y, curve.transmittance);
        if (mode == FOG_SQUARED) curve.effective_length *= x / LN2;
    }
    if (endless) curve.transmittance = exp(-sigma_t * MAX_OPTICAL_DEPTH);
    return curve;
}

ClosedFormFog fog_as_at_eye(int mode, Ray ray, float surface, bool endless) {
    Medium m = global_medium(ray.origin.y, 0.0, 1.0);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Curve curve = fog_curve(mode, to_extinction(m.optical_depth), surface, endless);
    ClosedFormFog fog;
    fog.glow = glow_over(m, curve.effective_length, ambient);
    fog.sun = vec3(0.0);
#if HAS_SUN
    Extinction arriving = exp(-to_extinction(sun_optical_depth(ray.origin.y, -sun_direction())));
    fog.sun = sun_over(ray, m, curve.effective_length * arriving);
    for (uint i = 0u; i < volumetrics.further_suns; ++i) {
        FurtherSun further = further_sun(i);
        arriving = exp(-to_extinction(sun_optical_depth(ray.origin.y, further.to_sun)));
        fog.glow += further.illuminance * volume_scattering(m, dot(further.to_sun, ray.direction)) *
                    (curve.effective_length * arriving);
    }
#endif
    fog.transmittance = curve.transmittance;
    return fog;
}

void main() {
    Ray ray = view_ray(gl_FragCoord.xy * volumetrics.viewport.zw);
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    int mode = int(volumetrics.fog_mode);
    ClosedFormFog fog;
    if (mode == FOG_HEIGHT)
        fog = fog_over_ray(ray, surface, is_background(depth), ambient);
    else
        fog = fog_as_at_eye(mode, ray, surface, is_background(depth));

    out_scattering = round_to_half(vec4(fog.glow + fog.sun, average(fog.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(fog.transmittance, average(fog.transmittance)));
#endif
    flush_work();
}
