// Some steps of the technique reference: emission, ambient light and the sun, and what the media leave of what is behind.
#include "shaders/volumetrics/techniques/reference.glsl"

uniform int last;  // 1 for the dispatch that ends the rays

const float FAR = 1.0e9;  // m

vec3 sun_source(Ray ray, float t, Medium m, MediaMask towards_sun) {
#if HAS_SUN
    vec3 point = ray.origin + ray.direction * t;
    Visibility visible = sun_visibility_at(point, t * ray.forward_cosine);
    if (is_dark(visible)) return vec3(0.0);
    vec3 to_sun = -sun_direction();
    int work = 0;
    vec3 depth = sun_optical_depth(point.y, to_sun) + local_optical_depth(point, to_sun, FAR, towards_sun, work);
    return volume_scattering(m, dot(to_sun, ray.direction)) * sun_illuminance() * exp(-depth) * visible;
#else
    return vec3(0.0);
#endif
}

void end_ray(Ray ray, Span span, vec3 ambient, vec3 depth, inout March march) {
    march.transmittance = exp(-depth);
    if (volumetrics.has_global == 0u || span.surface <= span.end) return;
    vec3 sun_front = vec3(0.0);
#if HAS_SUN
    sun_front = sun_optical_depth(ray.origin.y + ray.direction.y * span.end, -sun_direction());
#endif
    march_tail(ray, span.end, span.surface, span.endless, ambient, sun_front, march);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(radiance_image)))) return;
    Ray ray = view_ray((vec2(pixel) + 0.5) * volumetrics.viewport.zw);
    Span span = media_span(ray, pixel);
    vec3 ambient = volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
    March march;
    march.radiance = imageLoad(radiance_image, pixel).rgb;
    vec3 depth = imageLoad(optical_depth_image, pixel).rgb;

    float first = step_begin(span, first_step);
    float size = step_begin(span, first_step + step_count) - first;
    MediaMask on_ray = media_near(ray.origin + ray.direction * first, ray.direction, size, 0.0);
    MediaMask towards_sun = on_ray;
#if HAS_SUN
    vec3 middle = ray.origin + ray.direction * (first + 0.5 * size);
    towards_sun = media_near(middle, -sun_direction(), FAR, 0.5 * size);
#endif
    for (int i = first_step; i < first_step + step_count; ++i) {
        float a = step_begin(span, i);
        float b = step_begin(span, i + 1);
        if (a >= b || is_opaque(depth)) break;
        Medium m = global_medium(ray.origin.y + ray.direction.y * a, ray.direction.y, b - a);
        add_local_media(ray, a, b, on_ray, m);
        count_work(WORK_MEDIUM_SAMPLES, 1u);
        vec3 source = m.sigma_s * ambient + m.emission + sun_source(ray, 0.5 * (a + b), m, towards_sun);
        march.radiance += exp(-depth) * source * medium_optics(m, b - a).effective_length;
        depth = min(depth + m.optical_depth, MAX_OPTICAL_DEPTH);
    }

    if (last != 0) {
        end_ray(ray, span, ambient, depth, march);
        imageStore(radiance_image, pixel, vec4(march.radiance, average(march.transmittance)));
        imageStore(optical_depth_image, pixel, vec4(march.transmittance, average(march.transmittance)));
    } else {
        imageStore(radiance_image, pixel, vec4(march.radiance, 0.0));
        imageStore(optical_depth_image, pixel, vec4(depth, 0.0));
    }
    flush_work();
}
