// Ray marching after "Real-Time Volumetric Lighting using Ray Marching and Ordered Dithering", chapter 3.
// Along a pixel's view ray, per segment [a, b]:
//     L += T(0,a) int_a^b T(a,t) (sigma_s sum_i p V_i T_i E_i + e) dt,    T(0,b) = T(0,a) exp(-optical depth of [a,b])
// Media, transmittances and the inverse square of lamps are integrated in closed form, or nearly; only visibility is sampled,
// once a segment, at an offset that differs from pixel to pixel; EPIPOLAR: without noise, by the trees of epipolar.glsl,
// 2: without the sun, whose light along the whole ray comes from samples of its lines (epipolar_sunlight.glsl), each of which
// is what SUN_ALONE draws.
//
// PARTS: the unshadowed light of sun and lamps, without noise, and the visible share of it are stored apart
// (relight.frag), so that only the latter is filtered.
//
// LOCAL_MEDIA: 1 they only dim light, 2 they are in view too.
#define LIGHT_VOLUMES ((LOCAL_MEDIA > 0) + GRIDS)
#ifndef PARTS
#define PARTS 0
#endif
#ifndef EPIPOLAR
#define EPIPOLAR 0
#endif
#define SUN_APART (PARTS == 1 && HAS_SUN == 1)
#define LAMPS_APART (PARTS == 1 && LAMPS == 2)
#define SUMS_APART (PARTS == 1 || LOCAL_MEDIA == 2 || EPIPOLAR > 0)
#ifndef SUN_ALONE
#define SUN_ALONE 0
#endif

#include "shaders/volumetrics/reconstruction/noise_offset.glsl"
#include "shaders/volumetrics/light/part.glsl"
#include "shaders/volumetrics/light/segment_light.glsl"
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/light/epipolar_sunlight.glsl"
#if LOCAL_MEDIA == 2
#include "shaders/volumetrics/light/local_segment.glsl"
#endif
#include "shaders/volumetrics/light/needed_steps.glsl"

layout(early_fragment_tests) in;  // see modules/volumetrics/src/reconstruction/refine.cpp
layout(binding = 0) uniform sampler2D depth_texture;
layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif
#if SUN_APART
layout(location = 1 + CHROMATIC) out vec4 out_sun;
layout(location = 2 + CHROMATIC) out vec4 out_sun_share;
#define LAMPS_LOCATION (3 + CHROMATIC)
#else
#define LAMPS_LOCATION (1 + CHROMATIC)
#endif
#if LAMPS_APART
layout(location = LAMPS_LOCATION) out vec4 out_lamps;
layout(location = LAMPS_LOCATION + 1) out vec4 out_lamps_share;
#endif

// Half of the smallest half-float number: a transmittance of this is stored as 0, and nothing behind it shows.
const float OPAQUE = 2.98e-8;

#if EPIPOLAR && SUN_GLASS
const uint LEAST_GLASS_STEPS = 4u;  // of a ray through coloured light, each of GLASS_POINTS
#endif

#if SUMS_APART
Part sun_light = Part(vec3(0.0), vec3(0.0));
Part lamp_light = Part(vec3(0.0), vec3(0.0));
#endif

#if LOCAL_MEDIA == 2
#if LAMPS
// Neighbouring parts of a segment, to the lamps one medium.
struct LampPart {
    Segment segment;  // sigma_s, sigma_t: integrals over its length
    Medium medium;    // sigma_s too
    Extinction transmittance;  // to its front
};

LampPart no_lamp_part(float begin, float offset) {
    return LampPart(Segment(begin, begin, offset, 0.0, vec3(0.0), vec3(0.0)),
                    Medium(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0)), Extinction(1.0));
}

void add_lamps(Ray ray, LampPart part) {
    float path_length = part.segment.end - part.segment.begin;
    part.segment.sigma_s /= path_length;
    part.segment.sigma_t /= path_length;
    vec3 unshadowed;
    vec3 visible;
#if LAMPS == 1
    part.medium.sigma_s /= path_length;
    part.medium.sigma_s_rayleigh /= path_length;
    float t = part.segment.begin + part.segment.offset * path_length;
    vec3 effective_length = vec3(medium_optics(part.medium, path_length).effective_length);
    visible = lamps_at(ray, t, t, part.medium, unshadowed) * effective_length;
    unshadowed *= effective_length;
#else
    visible = lamps_over_segment(ray, part.segment, unshadowed);
#endif
    lamp_light.visible += part.transmittance * visible;
    lamp_light.whole += part.transmittance * unshadowed;
}

// How much scattering would change its place if two parts became one, relative to what there is.
float misplaced(LampPart a, LampPart b) {
    float a_length = a.segment.end - a.segment.begin;
    float b_length = b.segment.end - b.segment.begin;
    float a_amount = mean_channel(a.medium.sigma_s);
    float b_amount = mean_channel(b.medium.sigma_s);
    return 2.0 * abs(a_amount * b_length - b_amount * a_length) / max((a_length + b_length) * (a_amount + b_amount), 1.0e-30);
}

void add_to(LampPart b, inout LampPart a) {
    float a_particles = mean_channel(particle_sigma_s(a.medium));
    float b_particles = mean_channel(particle_sigma_s(b.medium));
    a.medium.anisotropy = (a_particles * a.medium.anisotropy + b_particles * b.medium.anisotropy) /
                          max(a_particles + b_particles, 1.0e-30);
    a.segment.anisotropy = a.medium.anisotropy;
    a.segment.end = b.segment.end;
    a.segment.sigma_s += b.segment.sigma_s;
    a.segment.sigma_t += b.segment.sigma_t;
    a.medium.sigma_s += b.medium.sigma_s;
    a.medium.sigma_s_rayleigh += b.medium.sigma_s_rayleigh;
    a.medium.optical_depth += b.medium.optical_depth;
}
#endif

#if HAS_SUN && !EPIPOLAR
// Of the parts of a segment the one in which the sun's visibility is sampled: each with the share of the sunlight that it
// gathers, in one pass. The parts own one after the other an interval of the offset, and what is left of it after each is
// the place in the part.
struct SunSample {
    float rest;
    float gathered;
    float begin;
    float end;
    float fall;
};

void offer(float begin, float end, float gathered, float fall, inout SunSample s) {
    s.gathered += gathered;
    float share = gathered / max(s.gathered, 1.0e-30);
    if (s.rest < share) {
        s.rest /= share;
        s.begin = begin;
        s.end = end;
        s.fall = fall;
    } else {
        s.rest = (s.rest - share) / max(1.0 - share, 1.0e-6);
    }
}
#endif

// A segment in parts, each of one medium: its own local media and its own sun.
void march_segment(Ray ray, float a, float b, float offset, inout Extinction sun_front, inout March march) {
    const float MOST_MISPLACED = 0.25;
#if LAMPS
    LampPart lamps = no_lamp_part(a, offset);
#endif
#if HAS_SUN && !EPIPOLAR
    vec3 sun = vec3(0.0);
    SunSample place = SunSample(1.0 - offset, 0.0, a, b, 0.0);
#endif
    float begin = a;
    // One round more than there are parts, so that add_lamps is inlined once.
    for (bool more = true; more;) {
        more = begin < b && largest(march.transmittance) > OPAQUE;
        bool first = begin == a;
#if LAMPS
        bool joins = false;
        LampPart part = lamps;
#endif
        if (more) {
            float end = next_cut(ray, begin, b, largest(march.transmittance));
            float path_length = end - begin;
            Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, path_length);
            count_work(WORK_MEDIUM_SAMPLES, 1u);
            vec3 global_sigma_s = m.sigma_s;
            vec3 global_depth = m.optical_depth;
            add_local_media(ray, begin, end, m);
            vec3 local_sigma_s = m.sigma_s - global_sigma_s;
            vec3 local_depth = m.optical_depth - global_depth;
            Optics optics = medium_optics(m, path_length);
            march.radiance += march.transmittance * ((m.sigma_s * ambient + m.emission) * optics.effective_length);
#if HAS_SUN
            SunSegment light = sun_part(ray, m, begin, end, optics, sun_front);
            vec3 gathered = march.transmittance * sun_scattering(ray, m, light.effective_length);
#if GRIDS
            gathered += march.transmittance * sun_later_orders;
#endif
            Segment segment = Segment(begin, end, offset, m.anisotropy,
                                      volumetrics.homogeneous_sigma_s.rgb + local_sigma_s, vec3(0.0));
            float fall = sunlight_fall(ray, segment, light.x);
            sun_light.whole += gathered;
#if EPIPOLAR
            sun_light.visible += sun_share(ray, begin, end, fall, offset) * min(gathered, 1.0e30);
#else
            offer(begin, end, mean_channel(min(gathered, 1.0e30)), fall, place);
            sun += gathered;
#endif
#endif
#if LAMPS
            part.segment = Segment(begin, end, offset, m.anisotropy,
                                   (volumetrics.homogeneous_sigma_s.rgb + local_sigma_s) * path_length,
                                   volumetrics.homogeneous_sigma_t.rgb * path_length + local_depth);
            part.medium = m;
            part.medium.sigma_s *= path_length;
            part.medium.sigma_s_rayleigh *= path_length;
            part.transmittance = march.transmittance;
            joins = misplaced(lamps, part) <= MOST_MISPLACED;
#endif
            march.transmittance *= optics.transmittance;
            begin = end;
        }
#if LAMPS
        if (!first && !joins) add_lamps(ray, lamps);
        if (!first && joins)
            add_to(part, lamps);
        else
            lamps = part;
#endif
    }
#if HAS_SUN && !EPIPOLAR
    sun_light.visible += sun_share(ray, place.begin, place.end, place.fall, 1.0 - place.rest) * sun;
#endif
}
#else
void march_segment(Ray ray, float a, float b, float offset, inout Extinction sun_front, inout March march) {
    float path_length = b - a;
    Medium m = global_medium(ray.origin.y + ray.direction.y * a, ray.direction.y, path_length);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Optics optics = medium_optics(m, path_length);
    Segment segment = Segment(a, b, offset, m.anisotropy, volumetrics.homogeneous_sigma_s.rgb,
                              volumetrics.homogeneous_sigma_t.rgb);
#if SUMS_APART
    SegmentLight light = segment_light_parts(ray, segment, m, optics, ambient, sun_front);
    march.radiance += march.transmittance * light.diffuse;
    sun_light.visible += march.transmittance * light.sun_visibility * light.sun;
    sun_light.whole += march.transmittance * light.sun;
    lamp_light.visible += march.transmittance * light.lamps;
    lamp_light.whole += march.transmittance * light.unshadowed_lamps;
#else
    march.radiance += march.transmittance * segment_light(ray, segment, m, optics, ambient, sun_front);
#endif
    march.transmittance *= optics.transmittance;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if SUN_ALONE
    if (!is_wanted(pixel)) discard;
#endif
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
#if SUN_ALONE
    if (of_samples) ray = sample_ray(pixel, pixel);
#endif
    float depth = texelFetch(depth_texture, pixel, 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    float begin = 0.0;
    float end = min(surface, volumetrics.max_distance);
#if LOCAL_MEDIA == 2
    const bool LIT = HAS_SUN + LAMPS > 0;
    find_chords(ray, 0.0, surface, LIT);
    // Without a global medium only the part of the ray that lies in local ones.
    if (volumetrics.has_global == 0u) {
        begin = min(media_span.x, end);
        end = min(end, media_span.y);
    }
#endif
#if EPIPOLAR
    const float offset = 0.5;
#else
    float offset = noise_offset(uvec2(gl_FragCoord.xy));
#endif
#if LAMPS
    expect_lamps(ray, begin, end, volumetrics.steps);
#endif

    March march = March(vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if EPIPOLAR == 1 && HAS_SUN
    sun_epipolar_ray = epipolar_ray(0, ray.direction);
#if SUN_ALONE
    end_with_samples(sun_epipolar_ray);
#endif
#endif
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * begin, -sun_direction()));
#if LOCAL_MEDIA == 2
    local_sun_front = local_sun_depth(ray, begin);
#endif
#endif
    float a = begin;
#if EPIPOLAR
    uint steps = needed_steps(ray, begin, end);
#if SUN_GLASS && HAS_SUN
    if (sun_epipolar_ray.glass) steps = max(steps, min(volumetrics.steps, LEAST_GLASS_STEPS));
#endif
    vec2 stepping = stepping_of(steps);
#else
    uint steps = volumetrics.steps;
    vec2 stepping = vec2(volumetrics.first_step, volumetrics.step_growth);
#endif
    float step_length = (end - a) * stepping.x;
    if (a >= end) steps = 0u;
    for (uint i = 0u; largest(march.transmittance) > OPAQUE; ++i) {
        float b = i + 1u == steps ? end : min(a + step_length, end);
        if (i >= steps) {
#if LOCAL_MEDIA == 2
            // Local media behind the march are one segment more.
            if (i > steps || media_span.y <= max(a, end)) break;
            end = media_span.y;
            b = end;
#else
            break;
#endif
        }
        march_segment(ray, a, b, offset, sun_front, march);
        step_length *= stepping.y;
        a = b;
    }
#if SUN_ALONE
    march.radiance = vec3(0.0);
#endif
    if (volumetrics.has_global != 0u && surface > end && end >= volumetrics.max_distance)
        march_tail(ray, end, surface, is_background(depth), ambient, sun_front, march);
#if EPIPOLAR == 2
    march.radiance += sunlight(pixel, march.transmittance);
#endif
#if SUMS_APART && PARTS == 0
    march.radiance += sun_light.visible + lamp_light.visible;
#endif

    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
#if SUN_ALONE
    out_scattering = sun_source(march.radiance, march.transmittance);
#endif
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
#if SUN_APART
    out_sun = round_to_half(vec4(sun_light.whole, 0.0));
    out_sun_share = visible_share(sun_light);
#endif
#if LAMPS_APART
    out_lamps = round_to_half(vec4(lamp_light.whole, 0.0));
    out_lamps_share = visible_share(lamp_light);
#endif
    flush_work();
}
