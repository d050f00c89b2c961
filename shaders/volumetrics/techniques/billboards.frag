// Layered camera-facing billboards, each the medium of a slab of view depths [a, b] as one translucent sheet:
//     radiance = (sigma_s (ambient + sum_i p V_i T_i E_i) + e) int_a^b T(a,t) dt,    transmittance = exp(-depth of [a, b])
// blended from the far to the near one: dst = radiance + dst * transmittance.
// Global media are sheets over the whole screen, and behind the last one a horizon in closed form. Local media are sheets
// over their own part of it; the optical depth is that of the chord in the shape, as of spherical billboards (Umenhoffer
// et al. 2006), by the mean density over it, and by the noise at a point of it. Soft against depth: the slab ends at the surface, so a sheet has the
// share of its medium that lies in front. Faded near the eye: density falls to 0 over the last `fade` metres.
//
// Sampled at one point of each sheet: the noise of local media, and light, the latter where the eye sees the sheet (equal shares
// of what is seen of it lie before equal offsets). Where that is differs from pixel to pixel (noise_offset), so that filters
// and means over frames find the mean over the sheet. Optical depth and fade of global media have no noise.
//
// What it cannot do: with noise none the point is the sheet's middle for all pixels, so that the edge of a shadow or of a
// lamp's glow is a step from sheet to sheet that moves with the camera, and a lamp between two sheets is too dim or too
// bright. Slabs that overlap are blended as if the
// one with the farther middle lay behind; no medium at the eye.
#include "shaders/interface/shadows.glsl"
#include "shaders/shared/sprites.h"
#include "shaders/volumetrics/light/lamps.glsl"
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#include "shaders/volumetrics/media/local_media.glsl"

layout(early_fragment_tests) in;

layout(binding = 0) uniform sampler2D depth_texture;
uniform float fade;  // m

layout(location = 0) flat in vec3 ambient;
layout(location = 1) flat in vec3 slab;

// One target for each channel that has its own transmittance: blending knows one alpha.
layout(location = 0) out vec4 out_red;
#if CHROMATIC
layout(location = 1) out vec4 out_green;
layout(location = 2) out vec4 out_blue;
#endif

// The part of the slab in which the billboard has a medium, metres along the ray; empty: x >= y.
vec2 sheet_part(Ray ray, vec2 part) {
    if (slab.z >= 0.0) return inside_shape(local_media[int(slab.z)], ray.origin, ray.direction, part.x, part.y);
    return part;
}

const int MOST_GRID_SAMPLES = 16;

Medium sheet_medium(Ray ray, vec2 part, vec3 point) {
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    float path_length = part.y - part.x;
    if (slab.z >= 0.0) {
        LocalMedium local = local_media[int(slab.z)];
        float density = mean_density(local, ray.origin, ray.direction, part.x, part.y);
        if (has_noise(local)) density *= noise_density(local, to_shape(local, point));
        density *= mean_grid(local, ray.origin, ray.direction, part.x, part.y,
                             width_at(ray, part.x, volumetrics.target.x), MOST_GRID_SAMPLES);
        Medium m;
        m.sigma_s = local.sigma_s_g.rgb * density;
        m.anisotropy = local.sigma_s_g.w;
        m.emission = local.emission_noise.rgb * density;
        m.optical_depth = local_sigma_t(local) * (density * path_length);
        m.sigma_s_rayleigh = vec3(0.0);
        return m;
    }
    return global_medium(ray.origin.y + ray.direction.y * part.x, ray.direction.y, path_length);
}

// Where in the part so much of the light that leaves its front has been gathered: a share of the optical depth, of which
// global media have as much before each point as a density that grows or falls exponentially from end to end.
float light_place(Ray ray, vec2 part, float offset, float depth) {
    float place = equal_transmittance(offset, depth);
#if HEIGHT_MEDIA
    if (slab.z >= 0.0) return place;
    vec2 y = ray.origin.y + ray.direction.y * part;
    float front = mean_channel(global_sigma_t(y.x)), back = mean_channel(global_sigma_t(y.y));
    place = equal_transmittance(place, log(max(front, 1.0e-30) / max(back, 1.0e-30)));
#endif
    return place;
}

March sheet(Ray ray, vec2 part, float offset) {
    Medium m = sheet_medium(ray, part, ray.origin + ray.direction * mix(part.x, part.y, offset));
    float share = fade > 0.0 ? clamp(0.5 * (part.x + part.y) / fade, 0.0, 1.0) : 1.0;
    m.optical_depth *= share;
    Optics optics = medium_optics(m, part.y - part.x);
    Extinction path = share * optics.effective_length;
    float t = mix(part.x, part.y, light_place(ray, part, offset, average(optics.depth)));
    vec3 point = ray.origin + ray.direction * t;

    vec3 radiance = (m.sigma_s * ambient + m.emission) * path;
#if HAS_SUN
    Visibility visible = sun_visibility_at(point, t * ray.forward_cosine);
    if (!is_dark(visible)) {
        vec3 arriving = exp(-(sun_optical_depth(point.y, -sun_direction()) + local_sun_optical_depth(point)));
        radiance += visible * arriving * sun_scattering(ray, m, path);
    }
#endif
#if LAMPS
    expect_lamps(ray, t, t, 1u);
    vec3 unshadowed;
    radiance += lamps_at(ray, t, t, m, unshadowed) * path;
#endif
    return March(radiance, optics.transmittance);
}

March horizon(Ray ray, float begin, float surface, bool endless) {
    March march = March(vec3(0.0), Extinction(1.0));
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * begin, -sun_direction()));
#endif
    march_tail(ray, begin, surface, endless, ambient, sun_front, march);
    return march;
}

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    vec2 part = sheet_part(ray, vec2(slab.x / ray.forward_cosine, min(slab.y / ray.forward_cosine, surface)));
    March march = March(vec3(0.0), Extinction(1.0));
    if (part.x < part.y) {
        if (int(slab.z) == BILLBOARD_HORIZON)
            march = horizon(ray, part.x, surface, is_background(depth));
        else
            march = sheet(ray, part, noise_offset(uvec2(gl_FragCoord.xy)));
    }
#if CHROMATIC
    out_red = vec4(march.radiance.r, 0.0, 0.0, march.transmittance.r);
    out_green = vec4(march.radiance.g, 0.0, 0.0, march.transmittance.g);
    out_blue = vec4(march.radiance.b, 0.0, 0.0, march.transmittance.b);
#else
    out_red = vec4(march.radiance, march.transmittance);
#endif
    flush_work();
}
