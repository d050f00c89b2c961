// Light of each slice of the froxels that reaches the eye through the global media: along the column's ray
//     T_global(0,a) int_a^b T(a,t) (sigma_s sum_i p V_i T_i E_i + e) dt,
// as in ray_march.frag with one segment a slice. The medium of the local media is what inject_media.comp has found.
//
// Behind the farthest surface of a column nothing is lit. The slice that holds this surface is lit up to it, so that
// nothing behind a wall leaks in, and then scaled as if the rest of the slice were lit alike: see gathered_share.
//
// FROXEL_HISTORY: sun and lamps are stored apart, unshadowed, with the visible share of them, which froxel_history.comp averages over the
// frames. Visibility is then sampled all over the froxel, not on the column's ray alone.
//
// LOCAL_MEDIA: local media are in view or dim light. SKY_ALONE: adds the sky's light, which differs from place to place, to froxels that
// are lit without.
#define LIGHT_VOLUMES (LOCAL_MEDIA + GRIDS)

uniform bool many_lamps;  // nothing but the lamps that are not among the few of the uniform block

#define LEFT_OUT(index) (many_lamps && is_few_lamp(index))
#define LAMP_RADIUS(light) max(light.intensity_radius.w, many_lamps ? core_radius(light) : 0.0)

#include "shaders/lib/sampling_noise.glsl"
#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/media/froxel_grid.glsl"
#include "shaders/volumetrics/light/part.glsl"

#include "shaders/volumetrics/light/segment_light.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform int run;  // slices that one invocation lights, and so the most it may do for nothing

layout(binding = 0) uniform sampler2D farthest_view_depth;
#if LOCAL_MEDIA
layout(binding = 1) uniform sampler3D froxel_scattering;  // rgb sigma_s, a sum of anisotropy * mean sigma_s
layout(binding = 2) uniform sampler3D froxel_extinction;  // rgb sigma_t
layout(binding = 3) uniform sampler3D froxel_emission;
#endif
#if SKY_ALONE
layout(rgba16f, binding = 0) uniform image3D froxel_radiance;
#else
layout(rgba16f, binding = 0) writeonly uniform image3D froxel_radiance;
#endif
#if FROXEL_HISTORY
layout(rgba16f, binding = 1) writeonly uniform image3D froxel_visibility;  // rgb lamps, a sun; < 0: there are none
#if HAS_SUN
layout(rgba16f, binding = 2) writeonly uniform image3D froxel_sun;
#endif
#if LAMPS
layout(rgba16f, binding = 3) writeonly uniform image3D froxel_lamps;
#endif
uniform vec3 visibility_jitter;  // x, y share of the column, z phase along the ray; z < 0: the middle of the froxel
#endif

// Half of the smallest half-float number: a transmittance of this is stored as 0, and nothing behind it shows.
const float OPAQUE = 2.98e-8;
// The least share of a slice that is lit: a shorter one would be scaled up from nothing.
const float LEAST_SHARE = 1.0 / 64.0;

// Where visibility is sampled, as a share of the light of the slice. With a history it moves along a low-discrepancy
// sequence from frame to frame, and other slices and columns are at other places of it.
float sample_offset(ivec3 froxel) {
#if FROXEL_HISTORY
    if (visibility_jitter.z >= 0.0) {
        float column = (float(bayer_rank(uvec2(froxel.xy), 4u)) + 0.5) / 16.0;
        return fract(visibility_jitter.z + column + float(froxel.z) * 0.61803399);
    }
#endif
    return 0.5;
}

#if FROXEL_HISTORY
// See visibility_point. Points of a plane of one view depth are linear in their place on the screen.
vec3 jittered_direction(Ray ray, ivec3 froxel, vec3 column_width, vec3 column_height) {
    if (visibility_jitter.z < 0.0) return ray.direction;
    // Rank-1 lattices: neighbours are at other places of the sequence.
    vec2 place = fract(visibility_jitter.xy + vec2(dot(vec3(froxel), vec3(0.7548776662, 0.5698402910, 0.3819660113)),
                                                   dot(vec3(froxel), vec3(0.5698402910, 0.7548776662, 0.6180339887))));
    return ray.direction + (place.x - 0.5) * column_width + (place.y - 0.5) * column_height;
}

vec3 beside(Ray ray, vec2 uv) {
    Ray other = view_ray(uv);
    return other.direction * (ray.forward_cosine / other.forward_cosine) - ray.direction;
}
#endif

// Adds the local media of a froxel to the segment and its medium.
void add_local_media(ivec3 froxel, inout Segment segment, inout Medium m) {
#if LOCAL_MEDIA
    if (volumetrics.local_media_count > 0u) {
        count_work(WORK_TEXTURE_FETCHES, 2u + volumetrics.local_emission);
        vec4 scattering = texelFetch(froxel_scattering, froxel, 0);
        vec3 sigma_t = texelFetch(froxel_extinction, froxel, 0).rgb;
        if (volumetrics.local_emission != 0u) m.emission += texelFetch(froxel_emission, froxel, 0).rgb;
        add_particles(scattering.rgb, scattering.a, m);
        m.optical_depth += sigma_t * (segment.end - segment.begin);
        segment.sigma_s += scattering.rgb;
        segment.sigma_t += sigma_t;
    }
#endif
    segment.anisotropy = m.anisotropy;
}

struct SliceLight {
    SegmentLight light;
    Extinction share;  // of the slice's light, that has been gathered
};

// `cut`: where the light of the slice ends, in it or behind it.
SliceLight slice_light(Ray ray, ivec3 froxel, float begin, float end, float cut, Ambient ambient, inout Extinction sun_front) {
    float lit_end = min(end, max(cut, mix(begin, end, LEAST_SHARE)));
    Segment segment = Segment(begin, lit_end, sample_offset(froxel), 0.0, volumetrics.homogeneous_sigma_s.rgb,
                              volumetrics.homogeneous_sigma_t.rgb);
    Medium m = global_medium(ray.origin.y + ray.direction.y * begin, ray.direction.y, lit_end - begin);
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    add_local_media(froxel, segment, m);
    Optics optics = medium_optics(m, lit_end - begin);
    SliceLight slice;
    slice.light = segment_light_parts(ray, segment, m, optics, ambient, sun_front);
    if (many_lamps) slice.light.diffuse = vec3(0.0);
    slice.share = Extinction(1.0);
    if (lit_end < end) {
        vec3 local_sigma_t = segment.sigma_t - volumetrics.homogeneous_sigma_t.rgb;
        Extinction whole = global_optical_depth(ray, begin, end) + to_extinction(local_sigma_t * (end - begin));
        slice.share = max(gathered_share(optics.depth, whole, (lit_end - begin) / (end - begin)), 1.0e-6);
    }
    return slice;
}

void store_slice(ivec3 froxel, SliceLight slice, Extinction transmittance) {
#if FROXEL_HISTORY
    SegmentLight light = slice.light;
    vec3 scale = vec3(transmittance / slice.share);
    vec4 visibility = vec4(-1.0);
#if HAS_SUN
    visibility.a = vec3(light.sun_visibility).r;
    imageStore(froxel_sun, froxel, round_to_half(vec4(scale * light.sun, 0.0)));
#endif
#if LAMPS
    vec4 lamps = visible_share(Part(light.lamps, light.unshadowed_lamps));
    if (lamps.a > 0.0) visibility.rgb = lamps.rgb;
    imageStore(froxel_lamps, froxel, round_to_half(vec4(scale * light.unshadowed_lamps, 0.0)));
#endif
    imageStore(froxel_visibility, froxel, round_to_half(visibility));
    imageStore(froxel_radiance, froxel, round_to_half(vec4(scale * light.diffuse, 0.0)));
#else
    vec3 radiance = vec3(transmittance * (sum_of(slice.light) / slice.share));
#if SKY_ALONE
    radiance += imageLoad(froxel_radiance, froxel).rgb;
#endif
    imageStore(froxel_radiance, froxel, round_to_half(vec4(radiance, 0.0)));
#endif
}

void main() {
    ivec3 size = imageSize(froxel_radiance);
    ivec3 froxel = ivec3(gl_GlobalInvocationID.xy, run * int(gl_WorkGroupID.z));
    if (any(greaterThanEqual(froxel, size))) return;
    float farthest = texelFetch(farthest_view_depth, froxel.xy, 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    int last = min(froxel_slice(farthest, size.z), froxel.z + run - 1);
    if (froxel.z > last || farthest <= 0.0) {
        flush_work();
        return;
    }

    Ray ray = view_ray((vec2(froxel.xy) + 0.5) / vec2(size.xy));
#if !SKY_VISIBILITY
    vec3 ambient = volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
#endif
    float cut = ray_distance_from_view_depth(farthest, ray.forward_cosine);
    float begin = ray_distance_from_view_depth(froxel_slice_begin(froxel.z, size.z), ray.forward_cosine);
#if LAMPS
    float run_end = ray_distance_from_view_depth(froxel_slice_begin(last + 1, size.z), ray.forward_cosine);
    expect_lamps(ray, begin, run_end, uint(last - froxel.z + 1));
#endif
    Extinction depth = global_optical_depth(ray, 0.0, begin);
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * begin, -sun_direction()));
#endif
#if FROXEL_HISTORY
    vec3 column_width = beside(ray, ray.uv + vec2(1.0 / float(size.x), 0.0));
    vec3 column_height = beside(ray, ray.uv + vec2(0.0, 1.0 / float(size.y)));
#endif
    for (; froxel.z <= last; ++froxel.z) {
        float end = ray_distance_from_view_depth(froxel_slice_begin(froxel.z + 1, size.z), ray.forward_cosine);
        Extinction transmittance = exp(-depth);
        SliceLight slice = SliceLight(SegmentLight(vec3(0.0), vec3(0.0), Visibility(-1.0), vec3(0.0), vec3(0.0)), Extinction(1.0));
#if FROXEL_HISTORY
        ray.visibility_direction = jittered_direction(ray, froxel, column_width, column_height);
#endif
#if SKY_VISIBILITY
        Ambient ambient = ambient_at(ray, 0.5 * (begin + min(end, max(cut, begin))));
#endif
        if (largest(transmittance) > OPAQUE)
            slice = slice_light(ray, froxel, begin, end, cut, ambient, sun_front);
        store_slice(froxel, slice, transmittance);
        depth += global_optical_depth(ray, begin, end);
        begin = end;
    }
    flush_work();
}
