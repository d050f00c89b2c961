// The local media themselves: at any point, and in the mean over any part of a line.
//
// GRIDS: some are density grids.
#ifndef VOLUMETRICS_LOCAL_MEDIA_GLSL
#define VOLUMETRICS_LOCAL_MEDIA_GLSL

#ifndef GRIDS
#define GRIDS 0
#endif
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/media/shape.glsl"
#if GRIDS
#include "shaders/volumetrics/media/grid.glsl"
#endif

layout(std430, binding = BINDING_LOCAL_MEDIA) readonly buffer LocalMediaBuffer { LocalMedium local_media[]; };

vec3 to_shape(LocalMedium medium, vec3 point) { return (medium.world_to_shape * vec4(point, 1.0)).xyz; }
vec3 direction_to_shape(LocalMedium medium, vec3 direction) { return mat3(medium.world_to_shape) * direction; }

bool has_noise(LocalMedium medium) { return medium.emission_noise.w > 0.0; }
bool has_height(LocalMedium medium) { return medium.noise_height.w > 0.0; }

#if GRIDS
bool has_grid(LocalMedium medium) { return shape_of(medium) == SHAPE_GRID; }
#else
bool has_grid(LocalMedium medium) { return false; }
#endif

float noise_density(LocalMedium medium, vec3 p) {
    return media_noise(p, medium.noise_height.x, medium.emission_noise.w, medium.seed_grid.x);
}

float local_density(LocalMedium medium, vec3 point) {
    vec3 p = to_shape(medium, point);
    float density = shape_density(medium, p);
    if (density <= 0.0) return 0.0;
    if (has_noise(medium)) density *= noise_density(medium, p);
#if GRIDS
    if (has_grid(medium)) density *= grid_density(medium, p);
#endif
    return density * media_height(point.y, medium.noise_height.z, medium.noise_height.w);
}

// Inside the shape the density is 1 everywhere.
bool is_homogeneous(LocalMedium medium) {
    return shape_is_even(medium) && !has_noise(medium) && !has_height(medium) && !has_grid(medium);
}

// The part of [begin, end] of a line in the shape, metres along the unit direction; none: x >= y.
vec2 inside_shape(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end) {
    vec2 chord = shape_chord(medium, to_shape(medium, origin), direction_to_shape(medium, direction));
    return vec2(max(chord.x, begin), min(chord.y, end));
}

// Mean of the soft rim over [begin, end] of the line o + d t, which lies in the shape; weighted by exp(-decay t). Along a line the
// rim rises to 1, and falls from it: nearly linearly, for the shapes are convex. So the line is cut where either ends, and in the
// middle, each piece again in two, and Gauss' rule of two nodes does the rest: within 2%, but for soft discs, flatter than 4 to 1,
// within 10%.
float mean_rim(LocalMedium medium, vec3 o, vec3 d, float begin, float end, float decay) {
    const float NODE = 0.5773502692;
    float softness = medium.extent_softness.w;
    if (end - begin < 0.2 * softness) return shape_density(medium, o + d * (0.5 * (begin + end)));
    vec2 chord = shape_chord(medium, o, d);
    float middle = 0.5 * (chord.x + chord.y);
    float rise = 0.1 * min(softness, 0.5 * (chord.y - chord.x));
    float up = softness * rise / max(shape_depth(medium, o + d * (chord.x + rise)), 1.0e-3 * rise);
    float down = softness * rise / max(shape_depth(medium, o + d * (chord.y - rise)), 1.0e-3 * rise);
    vec4 ends = vec4(min(chord.x + up, middle), middle, max(chord.y - down, middle), end);
    float heaviest = decay > 0.0 ? begin : end;
    vec2 sum = vec2(0.0);  // of weights, and of weights times the rim
    float a = begin;
    for (int i = 0; i < 4; ++i) {
        float b = min(ends[i], end);
        if (b <= a) continue;
        float quarter = 0.25 * (b - a);
        for (int k = 0; k < 4; ++k) {
            float t = a + quarter * (k < 2 ? 1.0 : 3.0) + quarter * ((k & 1) == 0 ? -NODE : NODE);
            float weight = quarter * exp(-decay * (t - heaviest));
            sum += weight * vec2(1.0, shape_density(medium, o + d * t));
        }
        a = b;
    }
    return sum.y / max(sum.x, 1.0e-30);
}

// Mean density over [begin, end] of a line, which lies in the shape; noise and grid apart. Exact for hard rims, and for heights.
float mean_density(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end) {
    float density = 1.0;
    float decay = 0.0;
    if (has_height(medium)) {
        decay = direction.y / medium.noise_height.w;
        density = height_mean_density(origin.y + direction.y * begin, direction.y, end - begin, medium.noise_height.z,
                                      medium.noise_height.w);
    }
    if (!shape_is_even(medium))
        density *= mean_rim(medium, to_shape(medium, origin), direction_to_shape(medium, direction), begin, end, decay);
    return density;
}

// Mean of the noise alone, from points a third of its largest features apart: from `most` at most.
float mean_noise(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end, int most) {
    if (!has_noise(medium)) return 1.0;
    vec3 o = to_shape(medium, origin);
    vec3 d = direction_to_shape(medium, direction);
    int count = clamp(int(ceil(3.0 * (end - begin) / medium.noise_height.x)), 1, most);
    float sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += noise_density(medium, o + d * mix(begin, end, (float(i) + 0.5) / float(count)));
    return sum / float(count);
}

// Mean of the grid alone, over `width` metres across: see grid.glsl.
float mean_grid(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end, float width, int most) {
#if GRIDS
    if (has_grid(medium))
        return grid_mean(medium, to_shape(medium, origin), direction_to_shape(medium, direction), begin, end, width, most);
#endif
    return 1.0;
}

vec3 local_sigma_t(LocalMedium medium) { return medium.sigma_s_g.rgb + medium.sigma_a_shape.rgb; }

#endif
