// The fog up to any depth along any view ray, interpolated from the froxels' light and transmittance, for whatever is drawn
// forward: alpha-blended surfaces and particles. froxel_apply.frag takes the opaque picture's from here too.
//
// Between slices light is interpolated as a medium lit alike gathers it, so that the last slice ends at the surface;
// between the four columns around the pixel linearly, without those that end long before its depth. The transmittance of
// the global media is closed form, and so is what they scatter behind the end of the froxels.
//
// A host's shader defines HAS_SUN as the module was told, LOCAL_MEDIA 1, CHROMATIC 1 and RAYLEIGH 1, and binds with
// Volumetrics::bind_fog.
#ifndef VOLUMETRICS_APPLY_GLSL
#define VOLUMETRICS_APPLY_GLSL

#include "shaders/volumetrics/media/froxel_grid.glsl"
#include "shaders/volumetrics/light/segment.glsl"

layout(binding = UNIT_FOG_COLUMNS) uniform sampler2D farthest_view_depth;
layout(binding = UNIT_FOG_RADIANCE) uniform sampler3D froxel_radiance;  // see froxel_accumulate.comp
#if LOCAL_MEDIA && CHROMATIC
layout(binding = UNIT_FOG_OPTICAL_DEPTH) uniform sampler3D froxel_optical_depth;
#endif

struct FogInFront {
    vec3 scattering;     // S(0, d): radiance
    vec3 transmittance;  // T(0, d)
};

// Light and optical depth of the local media up to the begin and the end of a slice.
struct Ends {
    vec3 radiance_begin;
    vec3 radiance_end;
    vec3 local_begin;
    vec3 local_end;
};

vec3 local_depth_at(ivec3 froxel, vec4 texel) {
#if LOCAL_MEDIA && CHROMATIC
    if (volumetrics.coloured_froxels == 0u) return vec3(texel.a);  // no medium is coloured: a host asks for both
    count_work(WORK_TEXTURE_FETCHES, 1u);
    return texelFetch(froxel_optical_depth, froxel, 0).rgb;
#else
    return vec3(texel.a);
#endif
}

// `beyond`, 0..1: how sure it is that the column sees past the pixel's surface, at whose outline it lies. Its slice is
// then lit behind the surface too, maybe by a lamp that the surface hides. So it is taken to send no more than the slice
// before it, in proportion to their lengths (`growth`).
void add_column(ivec3 froxel, float weight, float beyond, float growth, inout Ends ends) {
    count_work(WORK_TEXTURE_FETCHES, 1u);
    vec4 texel = texelFetch(froxel_radiance, froxel, 0);
    vec3 radiance_end = texel.rgb;
    ends.local_end += weight * local_depth_at(froxel, texel);
    if (--froxel.z >= 0) {
        count_work(WORK_TEXTURE_FETCHES, 1u);
        texel = texelFetch(froxel_radiance, froxel, 0);
        ends.radiance_begin += weight * texel.rgb;
        ends.local_begin += weight * local_depth_at(froxel, texel);
        if (beyond > 0.0) {
            vec3 before = vec3(0.0);
            if (froxel.z > 0) {
                count_work(WORK_TEXTURE_FETCHES, 1u);
                before = texelFetch(froxel_radiance, froxel - ivec3(0, 0, 1), 0).rgb;
            }
            vec3 limit = texel.rgb + growth * max(texel.rgb - before, 0.0);
            radiance_end = mix(radiance_end, min(radiance_end, limit), beyond);
        }
    }
    ends.radiance_end += weight * radiance_end;
}

// 1 for a column that reaches the view depth, falling to 0 for one that ends at half of it or before: behind that
// froxel_accumulate.comp has filled nothing in.
float depth_weight(float farthest, float view_depth) {
    return farthest >= view_depth ? 1.0 : max(2.0 * farthest / view_depth - 1.0, 0.0);
}

// growth: length of the slice relative to the one before it. opaque: what is there hides what is behind it.
Ends interpolate(vec2 uv, int slice, float view_depth, float growth, bool opaque, ivec2 size) {
    vec2 p = uv * vec2(size) - 0.5;
    ivec2 base = ivec2(floor(p));
    vec2 f = p - vec2(base);
    Ends ends = Ends(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 column = clamp(base + corner, ivec2(0), size - 1);
        vec2 side = mix(1.0 - f, f, vec2(corner));
        float farthest = texelFetch(farthest_view_depth, column, 0).r;
        count_work(WORK_TEXTURE_FETCHES, 1u);
        float weight = side.x * side.y * depth_weight(farthest, view_depth);
        if (weight <= 0.0) continue;
        float beyond = opaque ? clamp(min(farthest, froxel_far()) / view_depth - 1.0, 0.0, 1.0) : 0.0;
        add_column(ivec3(column, slice), weight, beyond, growth, ends);
        total += weight;
    }
    // A pixel of a lower resolution may look as deep as any of its block: then the columns of the block that reach so far are
    // asked instead.
    bool lower = opaque && total <= 0.0 && volumetrics.target != volumetrics.viewport;
    ivec2 first = ivec2(max(p - 0.5 * volumetrics.target.zw * vec2(size) + 0.5, 0.0));
    ivec2 last = min(ivec2(p + 0.5 * volumetrics.target.zw * vec2(size) + 0.5), size - 1);
    for (ivec2 column = first; lower && column.y <= last.y; column = ++column.x > last.x ? ivec2(first.x, column.y + 1) : column) {
        float weight = depth_weight(texelFetch(farthest_view_depth, column, 0).r, view_depth);
        count_work(WORK_TEXTURE_FETCHES, 1u);
        if (weight <= 0.0) continue;
        add_column(ivec3(column, slice), weight, 0.0, growth, ends);
        total += weight;
    }
    float scale = 1.0 / max(total, 1.0e-6);
    return Ends(ends.radiance_begin * scale, ends.radiance_end * scale, ends.local_begin * scale,
                ends.local_end * scale);
}

// What the froxels hold of a ray, up to the distance `end`: the view depth asked for, or the end of the volume.
struct FroxelPart {
    float end;
    vec3 radiance;
    Extinction global_depth;  // optical depths
    Extinction local_depth;
};

FroxelPart froxel_part(Ray ray, float surface, bool opaque) {
    float view_depth = min(surface, froxel_far());
    ivec3 size = textureSize(froxel_radiance, 0);
    int slice = froxel_slice(view_depth, size.z);
    float slice_begin = froxel_slice_begin(slice, size.z);
    float slice_end = froxel_slice_begin(slice + 1, size.z);
    float growth = (slice_end - slice_begin) / max(slice_begin - froxel_slice_begin(slice - 1, size.z), 1.0e-6);
    Ends ends = interpolate(ray.uv, slice, view_depth, growth, opaque, size.xy);

    float begin = ray_distance_from_view_depth(slice_begin, ray.forward_cosine);
    float end = ray_distance_from_view_depth(slice_end, ray.forward_cosine);
    float at = ray_distance_from_view_depth(view_depth, ray.forward_cosine);
    float length_share = clamp((view_depth - slice_begin) / (slice_end - slice_begin), 0.0, 1.0);
    Extinction local = to_extinction(max(ends.local_end - ends.local_begin, 0.0));
    Extinction share = gathered_share(global_optical_depth(ray, begin, at) + local * length_share,
                                      global_optical_depth(ray, begin, end) + local, length_share);

    return FroxelPart(at, mix(ends.radiance_begin, ends.radiance_end, vec3(share)), global_optical_depth(ray, 0.0, at),
                      to_extinction(ends.local_begin) + local * length_share);
}

// The global media behind the end of the froxels. surface: view depth [m] of what is there; endless: of nothing, so that the
// media go on.
void froxel_tail(Ray ray, float begin, float surface, bool endless, Ambient ambient, inout March march) {
    Extinction sun_front = Extinction(0.0);
#if HAS_SUN
    sun_front = to_extinction(sun_optical_depth(ray.origin.y + ray.direction.y * begin, -sun_direction()));
#endif
    march_tail(ray, begin, ray_distance_from_view_depth(surface, ray.forward_cosine), endless, ambient, sun_front, march);
}

// At screen position uv (0..1, origin lower left) up to a view depth [m].
FogInFront fog_at(vec2 uv, float view_depth) {
#if !SKY_VISIBILITY
    vec3 ambient = view_depth > froxel_far() && volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
#endif
    Ray ray = view_ray(uv);
    FroxelPart part = froxel_part(ray, view_depth, false);
#if SKY_VISIBILITY
    Ambient ambient = ambient_at(ray, part.end);
#endif
    March march = March(part.radiance, exp(-(part.global_depth + part.local_depth)));
    if (view_depth > froxel_far()) froxel_tail(ray, part.end, view_depth, false, ambient, march);
    return FogInFront(march.radiance, vec3(march.transmittance));
}

// A fragment at a view depth [m] in front of the already fogged picture, to be blended as dst = color + dst (1 - alpha).
// `color` is its radiance pre-multiplied by its coverage, highlights on glass whole; alpha: the share that it hides of each
// channel of what is behind it, for grey fragments the coverage.
//     Behind d the ray carries B, at the eye the picture shows dst = S(0,d) + T(0,d) B. With the fragment it is
//     S(0,d) + T(0,d) (color + (1 - alpha) B) = [T(0,d) color + alpha S(0,d)] + (1 - alpha) dst:
// the fog before the fragment is already in dst but for the part that the fragment hides. Any transmittance, coloured or
// not, needs no other blend factor. alpha 1 is an opaque surface in fog, alpha 0 a light in it.
vec3 apply_volumetrics(vec3 color, vec3 alpha, vec2 uv, float view_depth) {
    FogInFront fog = fog_at(uv, view_depth);
    return fog.transmittance * color + alpha * fog.scattering;
}

#endif
