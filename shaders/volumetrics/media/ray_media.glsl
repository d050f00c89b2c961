// The local media that a view ray meets, wherever froxels lie: each by its chord, and in the mean over any part of it by its
// own shape. Only their noise is read from a volume (noise_volume.comp).
#ifndef VOLUMETRICS_RAY_MEDIA_GLSL
#define VOLUMETRICS_RAY_MEDIA_GLSL

#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/media/froxel_depths.glsl"
#include "shaders/volumetrics/media/global_media.glsl"
#include "shaders/volumetrics/media/local_media.glsl"

// Per tile of the screen a bit for each local medium that may be seen in it, in words of 32.
layout(std430, binding = BINDING_SCREEN_MEDIA) readonly buffer ScreenMediaBuffer { uint screen_media[]; };

// See noise_volume.comp.
layout(binding = 1) uniform sampler3D noise_volume;

const int MOST_GRID_SAMPLES = 8;            // of a part of a ray
const int MOST_GRID_SAMPLES_OF_CHORD = 256;  // of all of it

// Chords that are kept. A ray may meet more media: those are found again wherever they are asked for, and cut nothing.
const int MAX_CHORDS = 16;
int chord_count = 0;
uint chord_medium[MAX_CHORDS];
vec2 chord_span[MAX_CHORDS];    // m along the ray
float chord_piece[MAX_CHORDS];  // m: the light in it is told apart in pieces of this length
vec2 media_span = vec2(0.0);    // of all that the ray meets
uint chords_left = 0xffffffffu; // the first medium that did not find a place

uint screen_media_words() { return (volumetrics.local_media_count + 31u) / 32u; }
uint screen_media_tile(vec2 uv) {
    uvec2 tile = uvec2(clamp(uv, 0.0, 0.999999) * vec2(SCREEN_MEDIA_X, SCREEN_MEDIA_Y));
    return (tile.y * uint(SCREEN_MEDIA_X) + tile.x) * screen_media_words();
}

// Noise over the mean noise of 1, in the mean over a part of the ray. Behind the froxels it is 1.
float noise_over(Ray ray, float begin, float end) {
    if (volumetrics.local_noise == 0u) return 1.0;
    float layers = float(textureSize(noise_volume, 0).z);
    vec2 w = vec2(froxel_w(begin * ray.forward_cosine), froxel_w(end * ray.forward_cosine));
    w = (clamp(w, 0.0, 1.0) * (layers - 1.0) + 0.5) / layers;
    count_work(WORK_TEXTURE_FETCHES, 2u);
    vec2 part = textureLod(noise_volume, vec3(ray.uv, w.y), 0.0).rg - textureLod(noise_volume, vec3(ray.uv, w.x), 0.0).rg;
    return part.g > 0.0 ? max(part.r, 0.0) / part.g : 1.0;
}

#if GRIDS
const float GRID_PIECES = 128.0;  // of a chord at most, where pieces are as long as voxels
const float GRID_GROWTH = 8.0;

// As long as what a pixel sees of a grid is wide, and a voxel or more; times the setting grid_piece.
float grid_piece(LocalMedium medium, Ray ray, vec2 span) {
    vec3 along = to_voxel(medium, vec4(direction_to_shape(medium, ray.direction), 0.0));
    float path_length = span.y - span.x;
    float finest = max(1.0 / length(along), width_at(ray, span.x, volumetrics.target.x));
    return path_length / clamp(ceil(path_length / (volumetrics.grid_piece * finest)), 1.0, GRID_PIECES / volumetrics.grid_piece);
}

float grid_growth(float transmittance) { return clamp(inversesqrt(max(transmittance, 1.0e-6)), 1.0, GRID_GROWTH); }

float empty_ahead(LocalMedium medium, Ray ray, float t) {
    return grid_empty_ahead(medium, to_shape(medium, ray.origin), direction_to_shape(medium, ray.direction), t);
}
#endif

// Finds the chords between two distances. `lit`: by lights that dense media dim within: a chord is told apart in the more
// pieces the denser it is, so that optical depths towards the light may be taken as linear over each.
void find_chords(Ray ray, float begin, float end, bool lit) {
    media_span = vec2(end, begin);
    uint tile = screen_media_tile(ray.uv);
    for (uint word = 0u; word < screen_media_words(); ++word) {
        for (uint bits = screen_media[tile + word]; bits != 0u; bits &= bits - 1u) {
            uint index = 32u * word + uint(findLSB(bits));
            LocalMedium medium = local_media[index];
            vec2 span = inside_shape(medium, ray.origin, ray.direction, begin, end);
            if (span.x >= span.y) continue;
            media_span = vec2(min(media_span.x, span.x), max(media_span.y, span.y));
            if (chord_count == MAX_CHORDS) {
                chords_left = min(chords_left, index);
                continue;
            }
            float path_length = span.y - span.x;
            float depth = mean_channel(local_sigma_t(medium)) * path_length;
            chord_medium[chord_count] = index;
            chord_span[chord_count] = span;
            chord_piece[chord_count] = lit ? path_length / clamp(ceil(3.0 * sqrt(depth)), 1.0, 12.0) : path_length;
#if GRIDS
            if (has_grid(medium)) chord_piece[chord_count] = grid_piece(medium, ray, span);
#endif
            ++chord_count;
        }
    }
}

// The next place behind `t` at which a chord begins or ends, or a piece of one, but not behind `end`. What is empty of a grid
// is one piece, and pieces of it grow as what is left of its light falls.
float next_cut(Ray ray, float t, float end, float transmittance) {
    float cut = end;
    float least = t + 4.0e-7 * t;
    for (int i = 0; i < chord_count; ++i) {
        vec2 span = chord_span[i];
        float next = span.x;
        if (next <= least && span.y > least)
            next = min(span.x + chord_piece[i] * (floor((least - span.x) / chord_piece[i]) + 1.0), span.y);
#if GRIDS
        LocalMedium medium = local_media[chord_medium[i]];
        if (has_grid(medium) && span.x <= least && span.y > least)
            next = min(t + max(chord_piece[i] * grid_growth(transmittance), empty_ahead(medium, ray, t)), span.y);
#endif
        if (next > least) cut = min(cut, next);
    }
    return cut;
}

#if GRIDS
vec3 grid_sigma_s = vec3(0.0);  // of the part of the ray that add_local_media saw last, 1/m
#endif

void add_medium(LocalMedium medium, Ray ray, float begin, float end, vec2 part, float noise, inout Medium m) {
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    float density = mean_density(medium, ray.origin, ray.direction, part.x, part.y);
    if (has_noise(medium)) density *= noise;
    density *= mean_grid(medium, ray.origin, ray.direction, part.x, part.y,
                         width_at(ray, 0.5 * (part.x + part.y), volumetrics.target.x), MOST_GRID_SAMPLES);
    float share = density * ((part.y - part.x) / (end - begin));
    vec3 sigma_s = medium.sigma_s_g.rgb * share;
#if GRIDS
    if (has_grid(medium)) grid_sigma_s += sigma_s;
#endif
    add_particles(sigma_s, medium.sigma_s_g.w * mean_channel(sigma_s), m);
    m.emission += medium.emission_noise.rgb * share;
    m.optical_depth += local_sigma_t(medium) * (density * (part.y - part.x));
}

// Adds the local media, in the mean over [begin, end].
void add_local_media(Ray ray, float begin, float end, inout Medium m) {
    float noise = -1.0;
#if GRIDS
    grid_sigma_s = vec3(0.0);
#endif
    for (int i = 0; i < chord_count; ++i) {
        vec2 part = vec2(max(chord_span[i].x, begin), min(chord_span[i].y, end));
        if (part.x >= part.y) continue;
        if (noise < 0.0) noise = noise_over(ray, begin, end);
        add_medium(local_media[chord_medium[i]], ray, begin, end, part, noise, m);
    }
    for (uint i = chords_left; i < volumetrics.local_media_count; ++i) {
        vec2 part = inside_shape(local_media[i], ray.origin, ray.direction, begin, end);
        if (part.x >= part.y) continue;
        if (noise < 0.0) noise = noise_over(ray, begin, end);
        add_medium(local_media[i], ray, begin, end, part, noise, m);
    }
}

// Optical depth of the local media between two distances along a ray; of `find_chords` it needs nothing.
vec3 local_optical_depth(Ray ray, float begin, float end) {
    vec3 depth = vec3(0.0);
    uint tile = screen_media_tile(ray.uv);
    for (uint word = 0u; word < screen_media_words(); ++word) {
        for (uint bits = screen_media[tile + word]; bits != 0u; bits &= bits - 1u) {
            LocalMedium medium = local_media[32u * word + uint(findLSB(bits))];
            vec2 part = inside_shape(medium, ray.origin, ray.direction, begin, end);
            if (part.x >= part.y) continue;
            count_work(WORK_MEDIUM_SAMPLES, 1u);
            float density = mean_density(medium, ray.origin, ray.direction, part.x, part.y);
            if (has_noise(medium)) density *= noise_over(ray, part.x, part.y);
            density *= mean_grid(medium, ray.origin, ray.direction, part.x, part.y,
                                 width_at(ray, part.x, volumetrics.target.x), MOST_GRID_SAMPLES_OF_CHORD);
            depth += local_sigma_t(medium) * (density * (part.y - part.x));
        }
    }
    return min(depth, MAX_OPTICAL_DEPTH);
}

#endif
