// Front to back: the light of each slice becomes the light of all slices up to its end, and beside it stands the optical
// depth of the local media up to there (the global media's is closed form, and their transmittance is in the light).
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/media/froxel_grid.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D farthest_view_depth;
#if LOCAL_MEDIA
layout(binding = 2) uniform sampler3D froxel_extinction;  // rgb sigma_t
#endif
layout(rgba16f, binding = 0) uniform image3D froxel_radiance;  // a: mean optical depth of the local media
#if LOCAL_MEDIA && CHROMATIC
layout(rgba16f, binding = 1) writeonly uniform image3D froxel_optical_depth;  // that of each channel
#endif

// Pixels of the columns beside this one look into it at their own depth. Behind its farthest surface its light goes on as
// before it, so long as froxel_apply.frag takes any of it.
const float BEYOND = 2.0;

struct Slice {
    float begin;  // along the ray, m
    float end;
    Extinction front;  // optical depth of the global media before it
    Extinction depth;  // and in it
};

Slice next_slice(Ray ray, Slice s, int slice, int count) {
    Slice next;
    next.begin = s.end;
    next.end = ray_distance_from_view_depth(froxel_slice_begin(slice + 1, count), ray.forward_cosine);
    next.front = s.front + s.depth;
    next.depth = global_optical_depth(ray, next.begin, next.end);
    return next;
}

// Light of a slice under light that is everywhere alike, to a factor.
Extinction uniform_light(Slice s) {
    return exp(-s.front) * mean_transmittance(s.depth, exp(-s.depth)) * (s.end - s.begin);
}

void main() {
    ivec3 size = imageSize(froxel_radiance);
    ivec3 froxel = ivec3(gl_GlobalInvocationID.xy, 0);
    if (any(greaterThanEqual(froxel.xy, size.xy))) return;
    float farthest = texelFetch(farthest_view_depth, froxel.xy, 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    if (farthest <= 0.0) {
        flush_work();
        return;
    }
    int last_lit = froxel_slice(farthest, size.z);
    int last = froxel_slice(BEYOND * farthest, size.z);
    Ray ray = view_ray((vec2(froxel.xy) + 0.5) / vec2(size.xy));

    vec3 radiance = vec3(0.0);
    vec3 light = vec3(0.0);
    vec3 local_depth = vec3(0.0);
    float begin = 0.0;
    for (; froxel.z <= last_lit; ++froxel.z) {
        light = imageLoad(froxel_radiance, froxel).rgb * exp(-to_extinction(local_depth));
        radiance += light;
#if LOCAL_MEDIA
        float end = ray_distance_from_view_depth(froxel_slice_begin(froxel.z + 1, size.z), ray.forward_cosine);
        local_depth += texelFetch(froxel_extinction, froxel, 0).rgb * (end - begin);
        count_work(WORK_TEXTURE_FETCHES, 1u);
        begin = end;
#if CHROMATIC
        imageStore(froxel_optical_depth, froxel, round_to_half(vec4(local_depth, 0.0)));
#endif
#endif
        imageStore(froxel_radiance, froxel, round_to_half(vec4(radiance, mean_channel(local_depth))));
    }
    if (last > last_lit) {
        Slice s;
        s.end = ray_distance_from_view_depth(froxel_slice_begin(last_lit, size.z), ray.forward_cosine);
        s.front = global_optical_depth(ray, 0.0, s.end);
        s.depth = Extinction(0.0);
        s = next_slice(ray, s, last_lit, size.z);
        vec3 source = light / max(uniform_light(s), 1.0e-30);
        for (; froxel.z <= last; ++froxel.z) {
            s = next_slice(ray, s, froxel.z, size.z);
            radiance += source * uniform_light(s);
#if LOCAL_MEDIA && CHROMATIC
            imageStore(froxel_optical_depth, froxel, round_to_half(vec4(local_depth, 0.0)));
#endif
            imageStore(froxel_radiance, froxel, round_to_half(vec4(radiance, mean_channel(local_depth))));
        }
    }
    flush_work();
}
