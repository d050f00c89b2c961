// Ray marching after "Real-Time Volumetric Lighting using Ray Marching and Ordered Dithering", chapter 3.
// Along a pixel's view ray, per segment [a, b]:
//     L += T(0,a) int_a^b T(a,t) (sigma_s sum_i p V_i T_i E_i + e) dt,    T(0,b) = T(0,a) exp(-optical depth of [a,b])
// Global media, transmittances and the inverse square of lamps are integrated in closed form; only local media and
// visibility are sampled, once a segment, at an offset that differs from pixel to pixel.
#include "shaders/volumetrics/froxel_depths.glsl"
#include "shaders/volumetrics/noise_offset.glsl"
#include "shaders/volumetrics/segment_light.glsl"
#include "shaders/lib/pack.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
#if LOCAL_MEDIA
layout(binding = 1) uniform sampler3D froxel_scattering;  // rgb sigma_s, a sum of anisotropy * mean sigma_s
layout(binding = 2) uniform sampler3D froxel_extinction;  // rgb sigma_t
#endif
#if LOCAL_MEDIA == 2
layout(binding = 3) uniform sampler3D froxel_emission;
#endif

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

// Half of the smallest half-float number: a transmittance of this is stored as 0, and nothing behind it shows.
const float OPAQUE = 2.98e-8;

// Adds the local media at a distance t to a segment of the global ones; returns their sigma_t.
vec3 add_local_media(Ray ray, float t, float path_length, inout Medium m, inout vec3 sigma_s) {
    vec3 sigma_t = vec3(0.0);
#if LOCAL_MEDIA
    float w = froxel_w(t * ray.forward_cosine);
    if (w > 1.0) return sigma_t;
    vec3 uvw = vec3(ray.uv, w);
    count_work(WORK_TEXTURE_FETCHES, 1u + uint(LOCAL_MEDIA));
    vec4 scattering = textureLod(froxel_scattering, uvw, 0.0);
    sigma_t = textureLod(froxel_extinction, uvw, 0.0).rgb;
#if LOCAL_MEDIA == 2
    m.emission += textureLod(froxel_emission, uvw, 0.0).rgb;
#endif
    add_particles(scattering.rgb, scattering.a, m);
    m.optical_depth += sigma_t * path_length;
    sigma_s += scattering.rgb;
#endif
    return sigma_t;
}

void march_segment(Ray ray, float a, float b, float offset, inout Extinction sun_front, inout March march) {
    float path_length = b - a;
    Medium m = global_medium(ray.origin.y + ray.direction.y * a, ray.direction.y, path_length);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    vec3 constant_sigma_s = volumetrics.homogeneous_sigma_s.rgb;
    vec3 constant_sigma_t = volumetrics.homogeneous_sigma_t.rgb;
    constant_sigma_t += add_local_media(ray, a + offset * path_length, path_length, m, constant_sigma_s);

    Optics optics = medium_optics(m, path_length);
    Segment segment = Segment(a, b, offset, m.anisotropy, constant_sigma_s, constant_sigma_t);
    march.radiance += march.transmittance * segment_light(ray, segment, m, optics, ambient, sun_front);
    march.transmittance *= optics.transmittance;
}

void main() {
    vec2 uv = screen_place(gl_FragCoord.xy);
    Ray ray = view_ray(uv);
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    // Without a global medium only the depths that hold local ones.
    vec2 medium = volumetrics.medium_depths.xy / ray.forward_cosine;
    float end = min(surface, min(volumetrics.march.x, medium.y));
    float offset = noise_offset(uvec2(gl_FragCoord.xy));

    March march = March(vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y, -sun_direction()));
#endif
    float a = medium.x;
    float step_length = (end - a) * volumetrics.march.y;
    uint steps = a < end ? volumetrics.counts.z : 0u;
    for (uint i = 0u; i < steps && largest(march.transmittance) > OPAQUE; ++i) {
        float b = i + 1u == steps ? end : min(a + step_length, end);
        march_segment(ray, a, b, offset, sun_front, march);
        step_length *= volumetrics.march.z;
        a = b;
    }
    if (surface > end && end == volumetrics.march.x) march_tail(ray, end, surface, is_background(depth), ambient, sun_front, march);

    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
    flush_work();
}
