// What a transparent fragment adds to the picture: dst = color + dst (1 - hidden).
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

struct Blended {
    vec3 color;
    vec3 hidden;
};

// color: radiance, pre-multiplied by the coverage (highlights whole); hidden: the share of what is behind; screen: 0..1;
// view_depth: m. Where color <= limit * hidden and dst <= limit, the sum is <= limit too: so what is brighter than that hides
// what is behind it, and no number of fragments leaves the range of half floats. This concerns a sun's highlight on clear glass.
Blended blended(vec3 color, vec3 hidden, vec2 screen, float view_depth) {
    const float limit = 65000.0;
#if FOG
    color = apply_volumetrics(color, hidden, screen, view_depth);
#endif
    color = clamp(color, 0.0, limit);
    float brightest = max(color.r, max(color.g, color.b)) / limit;
    return Blended(color, clamp(max(hidden, brightest), 0.0, 1.0));
}

#endif
