// What the passes of the technique reference share. It is brute force over the host's lights and shadows, per channel:
// the view ray is cut into many steps, a dispatch does a few of them and adds to what is held per pixel, so that no
// shader runs long.
#ifndef VOLUMETRICS_REFERENCE_GLSL
#define VOLUMETRICS_REFERENCE_GLSL

#define CHROMATIC 1

#include "shaders/interface/lights.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#include "shaders/volumetrics/light/visibility.glsl"
#if LOCAL_MEDIA
#include "shaders/volumetrics/media/local_media.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D depth_texture;
layout(rgba32f, binding = 0) uniform image2D radiance_image;       // a: see reference_lamps.comp
layout(rgba32f, binding = 1) uniform image2D optical_depth_image;  // from the eye on; a: the same

uniform int steps;        // of the ray
uniform int first_step;   // of this dispatch
uniform int step_count;
uniform int light_steps;  // per local medium on the way to a light

// The last step is e^3 = 20 times as long as the first. Among 0, 1, 2, 3, 4 this had the least error, or near it, in places
// of the sample level with and without near shadows.
const float STEP_GROWTH = 3.0;

// Optical depth from the eye behind which nothing shows: less than 1e-13 of it.
const float OPAQUE_DEPTH = 30.0;
bool is_opaque(vec3 optical_depth) { return min(optical_depth.r, min(optical_depth.g, optical_depth.b)) > OPAQUE_DEPTH; }

// The part of a view ray in which there may be media, as distances along it.
struct Span {
    float begin;
    float end;
    float surface;
    bool endless;  // nothing but sky
};

Span media_span(Ray ray, ivec2 pixel) {
    float depth = texelFetch(depth_texture, pixel, 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    Span span;
    span.surface = ray_distance_from_view_depth(view_depth_from_buffer(depth, volumetrics.eye.w), ray.forward_cosine);
    span.endless = is_background(depth);
    span.begin = 0.0;
    span.end = min(span.surface, volumetrics.max_distance);
    if (volumetrics.has_global != 0u) return span;
    span.begin = span.surface;
    span.end = 0.0;
#if LOCAL_MEDIA
    for (uint i = 0u; i < volumetrics.local_media_count; ++i) {
        vec2 inside = inside_shape(local_media[i], ray.origin, ray.direction, 0.0, span.surface);
        if (inside.x >= inside.y) continue;
        span.begin = min(span.begin, inside.x);
        span.end = max(span.end, inside.y);
    }
#endif
    span.end = max(span.begin, span.end);
    return span;
}

// Where step i begins, and the inverse.
float step_begin(Span span, int i) {
    return mix(span.begin, span.end, (exp(STEP_GROWTH * float(i) / float(steps)) - 1.0) / (exp(STEP_GROWTH) - 1.0));
}
float step_at(Span span, float t) {
    float share = (t - span.begin) / (span.end - span.begin);
    return float(steps) * log(1.0 + share * (exp(STEP_GROWTH) - 1.0)) / STEP_GROWTH;
}

// Which local media a loop is to look at, a bit for each: skipping them one by one inside the loop would cost
// rasterisers that run all lanes in step as much as doing them. Those past the last word are always looked at.
const uint MASK_WORDS = 8u;
struct MediaMask {
    uint words[MASK_WORDS];
};

uint mask_word_count() { return (volumetrics.local_media_count + 31u) / 32u; }
uint mask_word(MediaMask mask, uint word) {
    uint rest = volumetrics.local_media_count - 32u * word;
    return word < MASK_WORDS ? mask.words[word] : rest < 32u ? (1u << rest) - 1u : ~0u;
}

// Those that may come within a distance of the line from a over path_length metres.
MediaMask media_near(vec3 a, vec3 direction, float path_length, float distance) {
    MediaMask mask;
    for (uint word = 0u; word < MASK_WORDS; ++word) mask.words[word] = 0u;
#if LOCAL_MEDIA
    for (uint i = 0u; i < min(volumetrics.local_media_count, 32u * MASK_WORDS); ++i) {
        vec3 p = to_shape(local_media[i], a);
        vec3 d = mat3(local_media[i].world_to_shape) * direction;
        float radius = shape_radius(local_media[i]) + distance;
        p += d * clamp(-dot(p, d), 0.0, path_length);
        if (dot(p, p) <= radius * radius) mask.words[i / 32u] |= 1u << (i % 32u);
    }
#endif
    return mask;
}

// Adds the local media between a and b: each by its density in the middle of what lies in its shape.
void add_local_media(Ray ray, float a, float b, MediaMask mask, inout Medium m) {
#if LOCAL_MEDIA
    for (uint word = 0u; word < mask_word_count(); ++word) {
        for (uint bits = mask_word(mask, word); bits != 0u; bits &= bits - 1u) {
            LocalMedium medium = local_media[32u * word + uint(findLSB(bits))];
            vec2 inside = inside_shape(medium, ray.origin, ray.direction, a, b);
            if (inside.x >= inside.y) continue;
            float density_length = inside.y - inside.x;
            if (!is_homogeneous(medium))
                density_length *= local_density(medium, ray.origin + ray.direction * (0.5 * (inside.x + inside.y)));
            vec3 sigma_s = medium.sigma_s_g.rgb * (density_length / (b - a));
            add_particles(sigma_s, medium.sigma_s_g.w * mean_channel(sigma_s), m);
            m.emission += medium.emission_noise.rgb * (density_length / (b - a));
            m.optical_depth += local_sigma_t(medium) * density_length;
        }
    }
#endif
}

// Optical depth of the local media over path_length metres from a point; in closed form where their density is constant,
// else from light_steps samples in each. `work` counts loop iterations.
vec3 local_optical_depth(vec3 point, vec3 direction, float path_length, MediaMask mask, inout int work) {
    vec3 depth = vec3(0.0);
#if LOCAL_MEDIA
    if (volumetrics.light_transmittance == 0u) return depth;
    for (uint word = 0u; word < mask_word_count(); ++word) {
        for (uint bits = mask_word(mask, word); bits != 0u; bits &= bits - 1u) {
            LocalMedium medium = local_media[32u * word + uint(findLSB(bits))];
            ++work;
            vec2 inside = inside_shape(medium, point, direction, 0.0, path_length);
            if (inside.x >= inside.y) continue;
            float density = 1.0;
            if (has_grid(medium)) {
                density = mean_grid(medium, point, direction, inside.x, inside.y, 0.0, 8 * light_steps);
                work += 8 * light_steps;
            } else if (!is_homogeneous(medium)) {
                density = 0.0;
                for (int k = 0; k < light_steps; ++k) {
                    float t = mix(inside.x, inside.y, (float(k) + 0.5) / float(light_steps));
                    density += local_density(medium, point + direction * t);
                }
                density /= float(light_steps);
                work += light_steps * (1 + MEDIA_NOISE_OCTAVES);
            }
            depth += local_sigma_t(medium) * (density * (inside.y - inside.x));
        }
    }
#endif
    return depth;
}

#endif
