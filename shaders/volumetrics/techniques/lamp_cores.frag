// What froxels leave out of a lamp: of 1 / max(d^2, radius^2) the part above that of a larger radius, the core's. Both are integrated
// over the part of the pixel's ray within the core; the medium there is that at the lamp.
// LOCAL_MEDIA: local media are in view or dim light.
#define LIGHT_VOLUMES LOCAL_MEDIA

float lamp_radius = 0.0;
#define LAMP_RADIUS(light) lamp_radius

#include "shaders/lib/pack.glsl"
#include "shaders/volumetrics/frame/apply.glsl"
#include "shaders/volumetrics/light/lamps.glsl"

uniform uint lamp;

layout(binding = 0) uniform sampler2D depth_texture;
#if LOCAL_MEDIA
layout(binding = 1) uniform sampler3D froxel_scattering;  // see inject_media.comp
layout(binding = 2) uniform sampler3D froxel_extinction;
#endif
layout(location = 0) out vec4 out_scattering;

// At equal angles round the lamp, between which it sends equal light.
float visible_share(Ray ray, GpuLight light, FoundLamp found) {
    const int COUNT = 4;
    float h = max(found.lamp.h, 1.0e-4);
    float begin = atan(found.reach.begin - found.lamp.t_closest, h);
    float end = atan(found.reach.end - found.lamp.t_closest, h);
    float sum = 0.0;
    for (int i = 0; i < COUNT; ++i) {
        float t = found.lamp.t_closest + h * tan(mix(begin, end, (float(i) + 0.5) / float(COUNT)));
        sum += lamp_visibility(lamp, light, ray.origin + ray.direction * t);
    }
    return sum / float(COUNT);
}

void main() {
    GpuLight light = light_at(lamp);
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    float core = core_radius(light);
    FoundLamp found;
    found.index = lamp;
    found.lamp = lamp_ray(ray.origin, ray.direction, light.position_range.xyz);
    float half_chord = sqrt(max(core * core - found.lamp.h * found.lamp.h, 0.0));
    Medium m = global_medium(light.position_range.y, 0.0, 1.0);
    Segment segment = Segment(max(found.lamp.t_closest - half_chord, 0.0), min(found.lamp.t_closest + half_chord, surface), 0.5,
                              m.anisotropy, volumetrics.homogeneous_sigma_s.rgb, volumetrics.homogeneous_sigma_t.rgb);
    found.reach = lamp_reach(ray, segment, light, found.lamp);
    if (found.reach.begin >= found.reach.end) discard;
    Extinction front = global_optical_depth(ray, 0.0, segment.begin);
#if LOCAL_MEDIA
    if (volumetrics.local_media_count > 0u) {
        ivec3 size = textureSize(froxel_scattering, 0);
        float view_depth = dot(volumetrics.inverse_view[2].xyz, volumetrics.eye.xyz - light.position_range.xyz);
        ivec3 froxel = ivec3(ray.uv * vec2(size.xy), froxel_slice(view_depth, size.z));
        vec4 local = texelFetch(froxel_scattering, froxel, 0);
        count_work(WORK_TEXTURE_FETCHES, 2u);
        add_particles(local.rgb, local.a, m);
        segment.anisotropy = m.anisotropy;
        segment.sigma_s += local.rgb;
        segment.sigma_t += texelFetch(froxel_extinction, froxel, 0).rgb;
        front += froxel_part(ray, segment.begin * ray.forward_cosine, false).local_depth;
    }
#endif
    vec3 whole = vec3(0.0);
    vec3 of_froxels = vec3(0.0);
    lamp_radius = light.intensity_radius.w;
    lamp_over_segment(ray, segment, found, whole);
    lamp_radius = core;
    lamp_over_segment(ray, segment, found, of_froxels);
    vec3 peak = max(whole - of_froxels, 0.0) * visible_share(ray, light, found);
    out_scattering = round_to_half(vec4(peak * vec3(exp(-front)), 0.0));
    flush_work();
}
