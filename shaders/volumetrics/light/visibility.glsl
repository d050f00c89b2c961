// The visible share of the light that a part of a view ray gathers: EPIPOLAR 0 by one lookup, at a point that an offset
// (0..1) chooses, so that the mean over all offsets is the share; 1 by the trees of epipolar_share.glsl, with no offset.
// GLASS: it has a colour, that of the glass which the light has come through; the sun's where that may be of the sun, and
// the lamps' likewise.
#ifndef VOLUMETRICS_VISIBILITY_GLSL
#define VOLUMETRICS_VISIBILITY_GLSL

#include "shaders/interface/lights.glsl"
#include "shaders/interface/shadows.glsl"
#include "shaders/lib/lamp_segment.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/light/lamp_core.glsl"
#include "shaders/volumetrics/media/extinction.glsl"

#ifndef EPIPOLAR
#define EPIPOLAR 0
#endif
#if EPIPOLAR
#include "shaders/volumetrics/light/epipolar_share.glsl"
#endif
#ifndef GLASS
#define GLASS 0
#endif
#if GLASS
#define Visibility vec3
#else
#define Visibility float
#endif
#define SUN_GLASS ((GLASS & GLASS_SUN) != 0)
#define LAMP_GLASS ((GLASS & GLASS_LAMPS) != 0)
// 1: visibility is kept from frame to frame (froxel_history.comp), so that light is wanted with and without it, and it
// alone is sampled beside the ray.
#ifndef FROXEL_HISTORY
#define FROXEL_HISTORY 0
#endif

bool is_dark(float visible) { return visible <= 0.0; }
bool is_dark(vec3 visible) { return all(lessThanEqual(visible, vec3(0.0))); }

#if EPIPOLAR && GLASS
// The trees tell how much of a segment is lit; the colour of that is the mean over so many points of it that are lit.
const int GLASS_POINTS = 8;

vec3 mean_lit(vec4 sum) { return sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0); }
#endif

// Where visibility is sampled for a point of the ray.
vec3 visibility_point(Ray ray, float t) { return ray.origin + ray.visibility_direction * t; }

Visibility lamp_visibility(uint index, GpuLight light, vec3 point) {
    if (light.cone_shadow.z < 0.0) return Visibility(1.0);
    count_work(WORK_SHADOW_LOOKUPS, 1u);
#if LAMP_GLASS
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return light_visibility(index, light, point) * light_filter(index, light, point);
#else
    return Visibility(light_visibility(index, light, point));
#endif
}

#if HAS_SUN
Visibility sun_visibility_at(vec3 point, float view_depth) {
    count_work(WORK_SHADOW_LOOKUPS, 1u);
#if SUN_GLASS && !FROXEL_HISTORY
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return sun_visibility(point, view_depth) * sun_filter(point, view_depth);
#else
    return Visibility(sun_visibility(point, view_depth));
#endif
}

// Of sunlight that falls by exp(-fall) from `begin` to `end`.
#if EPIPOLAR
EpipolarRay sun_epipolar_ray = EpipolarRay(0, 1, 0, 0.0, 0.0, 1.0, 0.0, 1.0, false);  // set once a pixel

Visibility sun_share(Ray ray, float begin, float end, float fall, float offset) {
    if (sun_epipolar_ray.cells == 0) return Visibility(1.0);  // it casts no shadow
    float share = epipolar_share(sun_epipolar_ray, Gathering(begin, end, fall, false, NO_LAMP, vec4(0.0)));
#if SUN_GLASS
    vec4 lit = vec4(0.0);
    for (int i = 0; i < GLASS_POINTS && share > 0.0 && sun_epipolar_ray.glass; ++i) {
        float t = mix(begin, end, equal_transmittance((float(i) + 0.5) / float(GLASS_POINTS), fall));
        vec3 visible = sun_visibility_at(visibility_point(ray, t), t * ray.forward_cosine);
        if (!is_dark(visible)) lit += vec4(visible, 1.0);
    }
    return share * mean_lit(lit);
#else
    return Visibility(share);
#endif
}
#else
Visibility sun_share(Ray ray, float begin, float end, float fall, float offset) {
    float t = mix(begin, end, equal_transmittance(offset, fall));
    return sun_visibility_at(visibility_point(ray, t), t * ray.forward_cosine);
}
#endif
#endif

// Over all offsets the point is distributed as the light is: in the inverse square (Kulla and Fajardo 2012), and in what
// else varies by its four nodes.
vec3 lamp_point(Ray ray, vec2 reach, LampIntegral inverse_square, vec4 parts, float offset) {
    float advance = lamp_advance(inverse_square, lamp_segment_place(parts, offset) * inverse_square.total);
    advance = clamp(advance, 0.0, reach.y - reach.x);
    return visibility_point(ray, reach.x + advance);
}

// Of a lamp's light over [reach.x, reach.y] of the ray, of which each node of lamp_segment has its part.
Visibility lamp_share(Ray ray, uint index, GpuLight light, vec2 reach, LampIntegral inverse_square, vec4 parts, float offset) {
#if EPIPOLAR
    if (light.cone_shadow.z < 0.0) return Visibility(1.0);
    EpipolarRay of_lamp = epipolar_ray(1 + int(index), ray.direction);
    if (of_lamp.cells == 0) return Visibility(1.0);  // what is at the eye sees what the eye sees
    float share = epipolar_share(of_lamp, Gathering(reach.x, reach.y, 0.0, true, inverse_square, parts));
#if LAMP_GLASS
    vec4 lit = vec4(0.0);
    for (int i = 0; i < GLASS_POINTS && share > 0.0 && light.cone_shadow.w > 0.0; ++i) {
        vec3 visible = lamp_visibility(
            index, light, lamp_point(ray, reach, inverse_square, parts, (float(i) + 0.5) / float(GLASS_POINTS)));
        if (!is_dark(visible)) lit += vec4(visible, 1.0);
    }
    return share * mean_lit(lit);
#else
    return Visibility(share);
#endif
#else
    return lamp_visibility(index, light, lamp_point(ray, reach, inverse_square, parts, offset));
#endif
}

#endif
