// What a transparent fragment adds to the picture, for gl::Blend::over: dst = src.rgb + dst (1 - src.a).
#ifndef ENGINE_TRANSPARENT_BLEND_GLSL
#define ENGINE_TRANSPARENT_BLEND_GLSL

// Where the sky's light is turned off, a uniform says so.
#define HAS_AMBIENT 1

// A file is included once, be it in an #if that does not hold: so first what is needed in any case.
#include "shaders/engine/light_data.glsl"
#include "shaders/lib/depth.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/octahedral.glsl"
#include "shaders/lib/work.glsl"
#if FOG || MEDIUM_TRANSMITTANCE
#include "shaders/volumetrics/light/light_transmittance.glsl"
#endif
#if FOG
#define LOCAL_MEDIA 1
#define CHROMATIC 1
#include "shaders/volumetrics/frame/apply.glsl"
#endif

// color: radiance, pre-multiplied by the coverage alpha (highlights whole); screen: 0..1; view_depth: m.
// Where src <= limit * alpha and dst <= limit, the sum is <= limit too: so what is brighter than that hides what is behind
// it, and no number of fragments leaves the range of half floats. This concerns a sun's highlight on clear glass.
vec4 blended(vec3 color, float alpha, vec2 screen, float view_depth) {
    const float limit = 65000.0;
    vec4 src = vec4(color, alpha);
#if FOG
    src = apply_volumetrics(color, alpha, screen, view_depth);
#endif
    src.rgb = clamp(src.rgb, 0.0, limit);
    src.a = clamp(max(src.a, max(src.r, max(src.g, src.b)) / limit), 0.0, 1.0);
    return src;
}

#endif
