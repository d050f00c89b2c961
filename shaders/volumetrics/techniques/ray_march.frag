// Ray marching after "Real-Time Volumetric Lighting using Ray Marching and Ordered Dithering", chapter 3.
// Along a pixel's view ray, per segment [a, b]:
//     L += T(0,a) int_a^b T(a,t) (sigma_s sum_i p V_i T_i E_i + e) dt,    T(0,b) = T(0,a) exp(-optical depth of [a,b])
// Global media, transmittances and the inverse square of lamps are integrated in closed form; only local media and
// visibility are sampled, once a segment, at an offset that differs from pixel to pixel.
//
// PARTS: the unshadowed light of sun and lamps, without noise, and the visible share of it are stored apart
// (relight.frag), so that only the latter is filtered. Local media are then sampled in each run of
// froxel slices in which they hardly change.
//
// LOCAL_MEDIA: 1 they only dim light, 2 they are in view too.
#define LIGHT_VOLUMES (LOCAL_MEDIA > 0)
#ifndef PARTS
#define PARTS 0
#endif
#define SUN_APART (PARTS == 1 && HAS_SUN == 1)
#define LAMPS_APART (PARTS == 1 && LAMPS == 2)

#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/media/froxel_runs.glsl"
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"
#include "shaders/volumetrics/light/part.glsl"
#include "shaders/volumetrics/light/segment_light.glsl"
#include "shaders/lib/pack.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
#if LOCAL_MEDIA == 2
layout(binding = 1) uniform sampler3D froxel_scattering;  // rgb sigma_s, a sum of anisotropy * mean sigma_s
layout(binding = 2) uniform sampler3D froxel_extinction;  // rgb sigma_t
layout(binding = 3) uniform sampler3D froxel_emission;
#endif
#if PARTS && LOCAL_MEDIA == 2
layout(binding = 4) uniform usampler2D froxel_runs;
#endif

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

// Adds the local media at a place w of the froxels to a segment of the global ones; returns their sigma_t.
vec3 add_local_media(Ray ray, float w, float path_length, inout Medium m, inout vec3 sigma_s) {
    vec3 sigma_t = vec3(0.0);
#if LOCAL_MEDIA == 2
    if (w > 1.0) return sigma_t;
    vec3 uvw = vec3(ray.uv, w);
    count_work(WORK_TEXTURE_FETCHES, 2u + volumetrics.local_emission);
    vec4 scattering = textureLod(froxel_scattering, uvw, 0.0);
    sigma_t = textureLod(froxel_extinction, uvw, 0.0).rgb;
    if (volumetrics.local_emission != 0u) m.emission += textureLod(froxel_emission, uvw, 0.0).rgb;
    add_particles(scattering.rgb, scattering.a, m);
    m.optical_depth += sigma_t * path_length;
    sigma_s += scattering.rgb;
#endif
    return sigma_t;
}

#if PARTS
Part sun_light = Part(vec3(0.0), vec3(0.0));
Part lamp_light = Part(vec3(0.0), vec3(0.0));

void add_lamps(Ray ray, Segment segment, vec3 transmittance) {
#if LAMPS == 2
    vec3 unshadowed;
    lamp_light.visible += transmittance * lamps_over_segment(ray, segment, unshadowed);
    lamp_light.whole += transmittance * unshadowed;
#endif
}
#endif

#if PARTS && LOCAL_MEDIA == 2
const int MAX_PARTS = 64;  // of a segment that are told apart for the place of its visibility
FroxelRun run = FroxelRun(0, 0, 0.0, false, 0, -1, uvec2(0u));

#if HAS_SUN
Extinction local_sun_front = Extinction(0.0);  // optical depth of the local media between the sun and the place reached

// As sun_segment, through local media too.
SunSegment sun_part(Ray ray, float begin, float end, Optics optics, inout Extinction front) {
#if LIGHT_VOLUMES
    Extinction back = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * end, -sun_direction()));
    Extinction local_back = to_extinction(local_sun_optical_depth(ray.origin + ray.direction * end));
    SunSegment sun = sun_between(optics.depth, front + local_sun_front, back + local_back, end - begin);
    front = back;
    local_sun_front = local_back;
    return sun;
#else
    return sun_segment(ray, begin, end, optics, front);
#endif
}
#endif

// Unshadowed light without noise: a segment in parts of one run of froxel slices, of each its own medium and sun. Lamps
// see the mean medium of the segment.
void march_segment(Ray ray, float a, float b, float offset, inout Extinction sun_front, inout March march) {
    Segment segment = Segment(a, b, offset, 0.0, vec3(0.0), vec3(0.0));
    float scattering = 0.0;
    float anisotropy = 0.0;
    Extinction transmittance = march.transmittance;
    vec3 sun = vec3(0.0);
    float gathered[MAX_PARTS];  // sunlight up to the end of each part
    float ends[MAX_PARTS];
    float falls[MAX_PARTS];  // of what a part gathers a metre, by exp(-fall) from its begin to its end
    int last = -1;
    float begin = a;
    do {
        while (run.distance_end <= begin) next_froxel_run(froxel_runs, ray, run);
        float end = min(run.distance_end, b);
        float path_length = end - begin;
        Segment part = Segment(begin, end, offset, 0.0, volumetrics.homogeneous_sigma_s.rgb,
                               volumetrics.homogeneous_sigma_t.rgb);
        Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, path_length);
        count_work(WORK_MEDIUM_SAMPLES, 1u);
        if (run.in_media) {
            float w = froxel_run_w(run, 0.5 * (begin + end) * ray.forward_cosine);
            part.sigma_t += add_local_media(ray, w, path_length, m, part.sigma_s);
        }
        Optics optics = medium_optics(m, path_length);
        march.radiance += transmittance * ((m.sigma_s * ambient + m.emission) * optics.effective_length);
#if HAS_SUN
        SunSegment light = sun_part(ray, begin, end, optics, sun_front);
        sun += transmittance * sun_scattering(ray, m, light.effective_length);
        last = min(last + 1, MAX_PARTS - 1);
        gathered[last] = mean_channel(min(sun, 1.0e30));
        ends[last] = end;
        falls[last] = sunlight_fall(ray, part, light.x);
#endif
        float share = path_length / max(b - a, 1.0e-30);
        segment.sigma_s += share * part.sigma_s;
        segment.sigma_t += share * part.sigma_t;
        float particles = share * mean_channel(particle_sigma_s(m));
        scattering += particles;
        anisotropy += particles * m.anisotropy;
        transmittance *= optics.transmittance;
        begin = end;
    } while (begin < b);
    segment.anisotropy = anisotropy / max(scattering, 1.0e-30);
#if HAS_SUN
    // Visibility where the share `offset` of the sunlight has been gathered.
    int found = 0;
    float target = offset * gathered[last];
    while (found < last && gathered[found] < target) ++found;
    float before = found == 0 ? 0.0 : gathered[found - 1];
    float place = clamp((target - before) / max(gathered[found] - before, 1.0e-30), 0.0, 1.0);
    float t = mix(found == 0 ? a : ends[found - 1], ends[found], equal_transmittance(place, falls[found]));
    count_work(WORK_SHADOW_LOOKUPS, 1u);
    sun_light.visible += sun_visibility(visibility_point(ray, t), t * ray.forward_cosine) * sun;
    sun_light.whole += sun;
#endif
    add_lamps(ray, segment, vec3(march.transmittance));
    march.transmittance = transmittance;
}
#else
void march_segment(Ray ray, float a, float b, float offset, inout Extinction sun_front, inout March march) {
    float path_length = b - a;
    Medium m = global_medium(ray.origin.y + ray.direction.y * a, ray.direction.y, path_length);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    vec3 constant_sigma_s = volumetrics.homogeneous_sigma_s.rgb;
    vec3 constant_sigma_t = volumetrics.homogeneous_sigma_t.rgb;
#if LOCAL_MEDIA == 2
    float w = froxel_w((a + offset * path_length) * ray.forward_cosine);
    constant_sigma_t += add_local_media(ray, w, path_length, m, constant_sigma_s);
#endif

    Optics optics = medium_optics(m, path_length);
    Segment segment = Segment(a, b, offset, m.anisotropy, constant_sigma_s, constant_sigma_t);
#if PARTS
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
    vec2 uv = screen_place(gl_FragCoord.xy);
    Ray ray = view_ray(uv);
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    // Without a global medium only the depths that hold local ones.
    vec2 medium = volumetrics.medium_depths.xy / ray.forward_cosine;
    float end = min(surface, min(volumetrics.max_distance, medium.y));
    float offset = noise_offset(uvec2(gl_FragCoord.xy));

    March march = March(vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
#endif
#if PARTS && LOCAL_MEDIA == 2
    run = froxel_run_before(textureSize(froxel_scattering, 0).z);
#if HAS_SUN
    local_sun_front = to_extinction(local_sun_optical_depth(ray.origin + ray.direction * medium.x));
#endif
#endif
    float a = medium.x;
    float step_length = (end - a) * volumetrics.first_step;
    uint steps = a < end ? volumetrics.steps : 0u;
    for (uint i = 0u; i < steps && largest(march.transmittance) > OPAQUE; ++i) {
        float b = i + 1u == steps ? end : min(a + step_length, end);
        march_segment(ray, a, b, offset, sun_front, march);
        step_length *= volumetrics.step_growth;
        a = b;
    }
    if (surface > end && end == volumetrics.max_distance) march_tail(ray, end, surface, is_background(depth), ambient, sun_front, march);

    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
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
