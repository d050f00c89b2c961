// From the sums over the particles of a pixel to its light and transmittance.
//
// Global media: their transmittance is a closed form, and so is int T sigma_s dt, of which the particles' sum is an
// estimate. The light is scaled by the ratio of the two, of each channel where extinction is coloured: what is lit alike is exact
// with any number of particles, and only shadows and lamps are noise. Behind the particles: the closed form, without shadows
// or lamps.
// Local media: their transmittance is that of their shapes (ray_media.glsl); the light is scaled by the ratio of what this takes
// away, 1 - T, to what the particles' sum is for that.
// A pixel that no particle covers is lit as the nearest ones that some particle covers.
//
// What it cannot do: light that changes within a particle. One visibility for a particle: a shadow edge is as sharp as
// particles are small.
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#if LOCAL_MEDIA
#include "shaders/volumetrics/media/ray_media.glsl"
#endif

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 2) uniform sampler2D global_light;  // sums over particles (particles.frag)
layout(binding = 3) uniform sampler2D local_light;
#if CHROMATIC
layout(binding = 6) uniform sampler2D global_certain;
layout(binding = 7) uniform sampler2D local_certain;
#else
#define global_certain global_light  // in its alpha
#define local_certain local_light
#endif
uniform float reach;  // of the particles, m from the eye along the axes of the world

layout(location = 0) flat in vec3 ambient;
layout(location = 0) out vec4 out_scattering;
#if CHROMATIC
layout(location = 1) out vec4 out_transmittance;
#endif

struct Sum {
    vec3 light;
    Extinction certain;
};

void add_pixel(sampler2D light, sampler2D certain, ivec2 pixel, inout Sum sum) {
    count_work(WORK_TEXTURE_FETCHES, 1u + CHROMATIC);
#if CHROMATIC
    sum.light += texelFetch(light, pixel, 0).rgb;
    sum.certain += texelFetch(certain, pixel, 0).rgb;
#else
    vec4 texel = texelFetch(light, pixel, 0);
    sum.light += texel.rgb;
    sum.certain += texel.a;
#endif
}

// The pixel's own, else that of the eight nearest around it, or twice as far, and so on.
Sum covered_sum(sampler2D light, sampler2D certain) {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(light, 0) - 1;
    Sum sum = Sum(vec3(0.0), Extinction(0.0));
    add_pixel(light, certain, pixel, sum);
    for (int r = 1; average(sum.certain) <= 0.0 && r <= max(last.x, last.y); r *= 2)
        for (int i = 0; i < 9; ++i)
            add_pixel(light, certain, clamp(pixel + r * ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last), sum);
    return sum;
}

// The light of a pixel of which so much is certain.
vec3 scaled(Sum sum, Extinction certain) {
    return sum.light / max(sum.certain, 1.0e-30) * certain;
}

void add_global_media(Ray ray, float surface, bool endless, Extinction local_depth, inout March march) {
    vec3 along_axes = abs(ray.direction);
    float end = min(surface, reach / max(along_axes.x, max(along_axes.y, along_axes.z)));
    Medium m = global_medium(ray.origin.y, ray.direction.y, end);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    Optics optics = medium_optics(m, end);
#if CHROMATIC
    Extinction certain = m.sigma_s * optics.effective_length;
#else
    Extinction certain = mean_channel(m.sigma_s * optics.effective_length);
#endif
    march.radiance += scaled(covered_sum(global_light, global_certain), certain);
    // As if the local media were spread over the ray.
    march.radiance += m.emission * optics.effective_length * mean_transmittance(local_depth, exp(-local_depth));
    march.transmittance *= optics.transmittance;
    if (surface <= end) return;
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * end, -sun_direction()));
#endif
    march_tail(ray, end, surface, endless, ambient, sun_front, march);
}

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    March march = March(vec3(0.0), Extinction(1.0));
    Extinction local_depth = Extinction(0.0);
#if LOCAL_MEDIA
    local_depth = to_extinction(local_optical_depth(ray, 0.0, surface));
    march.transmittance = exp(-local_depth);
    Extinction taken = local_depth * mean_transmittance(local_depth, march.transmittance);
    march.radiance = scaled(covered_sum(local_light, local_certain), taken);
#endif
#if GLOBAL_MEDIA
    add_global_media(ray, surface, is_background(depth), local_depth, march);
#endif
    count_work(WORK_TEXTURE_FETCHES, 1u);
    out_scattering = round_to_half(vec4(march.radiance, average(march.transmittance)));
#if CHROMATIC
    out_transmittance = round_to_half(vec4(march.transmittance, average(march.transmittance)));
#endif
    flush_work();
}
