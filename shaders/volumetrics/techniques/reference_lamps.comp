// Some steps of the technique reference: every lamp of the light lists, at points of equal angle as seen from it (Kulla
// and Fajardo 2012), each with its own visibility, medium and way to the lamp. Before reference_media.comp does the
// same steps.
//
// Where lamps are many a dispatch does not finish them: it says so, and the next one goes on at the list entry that a
// pixel has kept in the alpha channels of the images.
#define HAS_SUN 0

#include "shaders/volumetrics/techniques/reference.glsl"
#include "shaders/volumetrics/light/lamps.glsl"

uniform int lamp_samples;  // per lamp

layout(std430, binding = BINDING_UNFINISHED) buffer UnfinishedBuffer { uint unfinished; };

const int MAX_STEP_COUNT = 16;
// Loop iterations of a pixel after which it stops. llvmpipe runs 8 pixels in step and ends all their loops together
// after about 65,000.
const int WORK_LIMIT = 8000;

// Optical depth of the local media from the first step's begin to each later one.
vec3 local_depth[MAX_STEP_COUNT + 1];

void fill_local_depth(Ray ray, Span span, MediaMask mask) {
    local_depth[0] = vec3(0.0);
#if LOCAL_MEDIA
    for (int i = 0; i < step_count; ++i) {
        Medium m = Medium(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0));
        add_local_media(ray, step_begin(span, first_step + i), step_begin(span, first_step + i + 1), mask, m);
        local_depth[i + 1] = local_depth[i] + m.optical_depth;
    }
#endif
}

vec3 local_depth_to(Span span, float t) {
#if LOCAL_MEDIA
    float at = clamp(step_at(span, t) - float(first_step), 0.0, float(step_count));
    int i = min(int(at), step_count - 1);
    return mix(local_depth[i], local_depth[i + 1], at - float(i));
#else
    return vec3(0.0);
#endif
}

Medium medium_at(vec3 point, MediaMask mask) {
    Medium m = global_medium(point.y, 0.0, 0.0);
#if LOCAL_MEDIA
    for (uint word = 0u; word < mask_word_count(); ++word) {
        for (uint bits = mask_word(mask, word); bits != 0u; bits &= bits - 1u) {
            LocalMedium medium = local_media[32u * word + uint(findLSB(bits))];
            vec3 sigma_s = medium.sigma_s_g.rgb * local_density(medium, point);
            add_particles(sigma_s, medium.sigma_s_g.w * mean_channel(sigma_s), m);
        }
    }
#endif
    return m;
}

// Local media on these steps of the ray, and between them and a lamp.
struct MediaMasks {
    MediaMask on_ray;
    MediaMask towards_lamp;
};

// Of the light a lamp sends to a point of the ray, what comes to `begin`, per metre, apart from the inverse square.
vec3 scattered(Ray ray, Span span, float begin, float t, GpuLight light, uint index, MediaMasks masks, inout int work) {
    vec3 point = ray.origin + ray.direction * t;
    vec3 to_lamp = light.position_range.xyz - point;
    float distance_squared = dot(to_lamp, to_lamp);
    float distance = sqrt(distance_squared);
    to_lamp /= max(distance, 1.0e-6);
    float inverse_range = lamp_inverse_range(light);
    float s = distance_squared * inverse_range * inverse_range;
    Visibility strength = Visibility(clamp(1.0 - s * s, 0.0, 1.0));
    if (is_spot(light)) strength *= spot_cone(-dot(to_lamp, light.direction_type.xyz), light.cone_shadow.xy);
    if (!is_dark(strength)) strength *= lamp_visibility(index, light, point);
    if (is_dark(strength)) return vec3(0.0);
    Medium m = medium_at(point, masks.on_ray);
    float advance = t - begin;
    vec3 depth = volumetrics.homogeneous_sigma_t.rgb * advance +
                 height_optical_depth(ray.origin.y + ray.direction.y * begin, ray.direction.y, advance) +
                 local_depth_to(span, t) + lamp_optical_depth(point.y, to_lamp, distance) +
                 local_optical_depth(point, to_lamp, distance, masks.towards_lamp, work);
#if LOCAL_MEDIA
    work += (1 + MEDIA_NOISE_OCTAVES) * int(volumetrics.local_media_count);
#endif
    work += 4 * int(volumetrics.height_media_count);
    return volume_scattering(m, dot(to_lamp, ray.direction)) * exp(-depth) * strength;
}

vec3 lamp_over_steps(Ray ray, Span span, float begin, FoundLamp found, MediaMask on_ray, inout int work) {
    GpuLight light = light_at(found.index);
    float a = found.reach.begin - found.lamp.t_closest;
    float size = found.reach.end - found.reach.begin;
    LampIntegral integral = lamp_integral(a, a + size, size, found.lamp.h, light.intensity_radius.w);
    vec3 middle = ray.origin + ray.direction * (found.reach.begin + 0.5 * size);
    vec3 to_lamp = light.position_range.xyz - middle;
    float distance = max(length(to_lamp), 1.0e-6);
    MediaMasks masks = MediaMasks(on_ray, media_near(middle, to_lamp / distance, distance, 0.5 * size));
    vec3 sum = vec3(0.0);
    for (int k = 0; k < lamp_samples; ++k) {
        float share = (float(k) + 0.5) / float(lamp_samples);
        float t = found.reach.begin + clamp(lamp_advance(integral, share * integral.total), 0.0, size);
        count_work(WORK_LIGHT_EVALUATIONS, 1u);
        sum += scattered(ray, span, begin, t, light, found.index, masks, work);
    }
    work += lamp_samples + int(volumetrics.local_media_count);
    return light.intensity_radius.rgb * sum * (integral.total / float(lamp_samples));
}

// In the images' alpha: lists passed since the first, -1 when all is done; and entries taken of the one now read.
const float DONE = -1.0;

LampWalk resumed_walk(Ray ray, Segment segment, float lists, float entries) {
    LampWalk walk = lamp_walk(ray, segment);
    if (lists == 0.0 && entries == 0.0) return walk;
    for (int i = 0; i <= int(lists); ++i) next_slice(ray, segment, walk);
    walk.next += uint(entries);
    return walk;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance_image)))) return;
    vec4 radiance = imageLoad(radiance_image, pixel);
    vec4 depth = imageLoad(optical_depth_image, pixel);
    if (radiance.a == DONE || is_opaque(depth.rgb)) return;
    Ray ray = view_ray((vec2(pixel) + 0.5) * volumetrics.viewport.zw);
    Span span = media_span(ray, pixel);
    float begin = step_begin(span, first_step);
    Segment segment = Segment(begin, step_begin(span, first_step + step_count), 0.0, 0.0, vec3(0.0), vec3(0.0));
    MediaMask on_ray = media_near(ray.origin + ray.direction * begin, ray.direction, segment.end - begin, 0.0);
    fill_local_depth(ray, span, on_ray);

    int first_slice = lamp_walk(ray, segment).slice + 1;
    LampWalk walk = resumed_walk(ray, segment, radiance.a, depth.a);
    FoundLamp found;
    vec3 sum = vec3(0.0);
    int work = 0;
    bool more = next_lamp(ray, segment, walk, found);
    for (; more && work < WORK_LIMIT; more = next_lamp(ray, segment, walk, found))
        sum += lamp_over_steps(ray, span, begin, found, on_ray, work);

    vec2 state = vec2(DONE, 0.0);
    if (more) {
        // The lamp that was found but not done is found again.
        state = vec2(float(walk.slice - first_slice),
                     float(walk.next - 1u - lights_in_slice(ray.uv, walk.slice).offset));
        unfinished = 1u;
    }
    imageStore(radiance_image, pixel, vec4(radiance.rgb + exp(-depth.rgb) * sum, state.x));
    imageStore(optical_depth_image, pixel, vec4(depth.rgb, state.y));
    flush_work();
}
