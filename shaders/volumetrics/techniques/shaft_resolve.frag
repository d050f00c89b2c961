// Technique shaft_geometry, last pass: the whole ray under sun, ambient light and emission in closed form, the sum over the
// faces of the sun's shadow volume, and lamps. A lamp's volume is its cone or the sphere of its range; it needs no triangles:
// the part of the ray in it is exact (lamp_reach). Its inverse square is in closed form; shadows are sampled at equal
// angles as seen from the lamp, once in each part, at an offset that differs from pixel to pixel. That is all that is sampled:
// sun, ambient light, emission and transmittance have no noise. PARTS: the lamps' unshadowed light and the visible share
// of it are stored apart (relight.frag), so that a filter takes the latter alone.
//
// Cannot: local media; lamps behind max_distance; shadow edges finer than the grid, or several edges on one line towards the
// sun (glass). One anisotropy holds for all lamps of a ray.
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/techniques/shaft_sun.glsl"
#if LAMPS
#include "shaders/volumetrics/light/lamps.glsl"
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"
#include "shaders/volumetrics/light/part.glsl"
uniform int shaft_lamp_parts;
#endif

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform sampler2D face_light;

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif
#if PARTS
layout(location = 1 + CHROMATIC) out vec4 out_lamps;
layout(location = 2 + CHROMATIC) out vec4 out_lamps_share;
#endif

#if LAMPS
// Of parts that gather the same share of the inverse square, the one from a part's begin to its end, with its own shadow.
void add_lamp_in_parts(Ray ray, Segment segment, FoundLamp found, inout Part light) {
    Reach whole = found.reach;
    float a = whole.begin - found.lamp.t_closest;
    float span = whole.end - whole.begin;
    LampIntegral integral = lamp_integral(a, a + span, span, found.lamp.h, light_at(found.index).intensity_radius.w);
    found.reach.end = whole.begin;
    for (int i = 1; i <= shaft_lamp_parts; ++i) {
        float share = float(i) / float(shaft_lamp_parts);
        float advance = i == shaft_lamp_parts ? span : clamp(lamp_advance(integral, share * integral.total), 0.0, span);
        found.reach.begin = found.reach.end;
        found.reach.end = max(whole.begin + advance, found.reach.begin);
        if (found.reach.begin < found.reach.end) light.visible += lamp_over_segment(ray, segment, found, light.whole);
    }
}

Part lamps_to(Ray ray, float end) {
    Medium m = global_medium(ray.origin.y, ray.direction.y, end);
    Segment segment = Segment(0.0, end, noise_offset(uvec2(gl_FragCoord.xy)), m.anisotropy, volumetrics.homogeneous_sigma_s.rgb,
                              volumetrics.homogeneous_sigma_t.rgb);
    Part light = Part(vec3(0.0), vec3(0.0));
    LampWalk walk = lamp_walk(ray, segment);
    FoundLamp found;
    expect_lamps(ray, 0.0, end, uint(shaft_lamp_parts));
    while (next_lamp(ray, segment, walk, found)) {
        Part lamp = Part(vec3(0.0), vec3(0.0));
        add_lamp_in_parts(ray, segment, found, lamp);
        light.visible += float(walk.stride) * lamp.visible;
        light.whole += float(walk.stride) * lamp.whole;
    }
    return light;
}
#endif

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);

    March march = March(vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
#endif
    float end = min(surface, shaft_cuts.w);
    float a = 0.0;
    for (int k = 1; a < end; ++k) {
        float b = shaft_cut(k, end);
        add_global(ray, a, b, ambient, sun_front, march);
        a = b;
    }
#if HAS_SUN
    march.radiance += texelFetch(face_light, ivec2(gl_FragCoord.xy), 0).rgb;
    count_work(WORK_TEXTURE_FETCHES, 1u);
#endif
#if LAMPS
    Part lamps = lamps_to(ray, min(surface, volumetrics.max_distance));
#if PARTS
    out_lamps = round_to_half(vec4(lamps.whole, 0.0));
    out_lamps_share = visible_share(lamps);
#else
    march.radiance += lamps.visible;
#endif
#endif
    vec3 optical_depth = height_optical_depth(ray.origin.y, ray.direction.y, surface) +
                         volumetrics.homogeneous_sigma_t.rgb * (is_background(depth) ? MAX_OPTICAL_DEPTH : surface);
    march.transmittance = exp(-to_extinction(optical_depth));

    // Rounding of the sum over the faces may leave less than nothing.
    out_scattering = round_to_half(vec4(max(march.radiance, 0.0), average(march.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
    flush_work();
}
