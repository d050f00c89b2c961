// Places particles and lights each of them once. A particle stands for the medium in a share of space: with the volume V it
// sends
//     V T (sigma_s (ambient + sum_i p V_i T_i E_i) + e)    [radiance m^2]
// to the eye, which particles.frag spreads over a disc. T is the mean transmittance along the particle's diameter.
//
// Global media: a lattice of cells round the eye, four levels, each twice as coarse and as wide as the one before. Every
// cell holds one particle at a place that depends on the cell alone, so particles stay where they are when the eye moves,
// and there are as many everywhere; between the levels the volume fades from one to the other. Local media: a
// low-discrepancy sequence in each shape. All positions are functions of time: nothing is kept from frame to frame. Where
// frames are averaged each has other positions, which go on with the sequence.
#define CHROMATIC 1

#include "shaders/interface/shadows.glsl"
#include "shaders/shared/sprites.h"
#include "shaders/volumetrics/light/lamps.glsl"
#include "shaders/volumetrics/light/segment.glsl"
#include "shaders/volumetrics/media/local_media.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = BINDING_SPRITES) writeonly buffer ParticleBuffer { ParticleSprite particles[]; };

uniform uint first;  // of this dispatch
uniform uint count;
uniform int medium;            // index of the local medium; -1: the global ones
uniform float radius;          // m
uniform float volume;          // m^3
uniform mat4 view_projection;  // of points relative to the eye
// Global media: one level.
uniform int side;              // cells
uniform ivec3 lower_cell;      // its number in the world
uniform vec3 lower_corner;     // of that cell, m from the eye
uniform float spacing;         // m
uniform vec2 reach;            // m from the eye along the axes: where the level before this one ends, and where this one does
// Local media.
uniform float drift;           // m, since time 0
uniform uint placement;        // frame of the noise in time, where frames are averaged

const float FADE_SHARE = 0.25;  // of the reach of a level

float level_share(float distance, float end) {
    return end > 0.0 ? clamp((end - distance) / (FADE_SHARE * end), 0.0, 1.0) : 0.0;
}

const uvec3 R3 = uvec3(3518319155u, 2882110345u, 2360945575u);  // Roberts 2018, times 2^32

vec3 lattice_particle(uint index) {
    uvec3 cell = uvec3(index, index / uint(side), index / uint(side * side)) % uint(side);
    uint x = hash_uvec3(uvec3(ivec3(cell) + lower_cell), uint(side));
    uint y = hash_uint(x);
    uvec3 place = uvec3(x, y, hash_uint(y)) + placement * R3;
    return lower_corner + (vec3(cell) + vec3(unit_float(place.x), unit_float(place.y), unit_float(place.z))) * spacing;
}

// The R3 sequence in the shape.
vec3 shape_particle(LocalMedium local, uint index) {
    uvec3 r = (index + 1u + placement * count) * R3;
    vec3 u = vec3(unit_float(r.x), unit_float(r.y), unit_float(r.z));
    vec3 eye = to_shape(local, volumetrics.eye.xyz);
    return transpose(mat3(local.world_to_shape)) * (shape_place(local, u, drift) - eye);
}

// Some of the sphere may be seen: not outside of one of the four sides of the view, nor behind the eye.
bool in_view(vec3 center, vec4 clip) {
    mat4 rows = transpose(view_projection);
    for (int i = 0; i < 4; ++i) {
        vec4 plane = rows[3] + ((i & 1) == 0 ? 1.0 : -1.0) * rows[i >> 1];
        if (dot(plane.xyz, center) + plane.w < -radius * length(plane.xyz)) return false;
    }
    return clip.w > -radius;
}

// Of all local media over path_length metres from the eye.
vec3 local_optical_depth(vec3 direction, float path_length) {
    const int MOST_SAMPLES = 4;  // of the noise of each
    const int MOST_GRID_SAMPLES = 32;
    vec3 depth = vec3(0.0);
    for (uint i = 0u; i < volumetrics.local_media_count; ++i) {
        LocalMedium local = local_media[i];
        vec2 inside = inside_shape(local, volumetrics.eye.xyz, direction, 0.0, path_length);
        if (inside.x >= inside.y) continue;
        float density = mean_density(local, volumetrics.eye.xyz, direction, inside.x, inside.y) *
                        mean_noise(local, volumetrics.eye.xyz, direction, inside.x, inside.y, MOST_SAMPLES) *
                        mean_grid(local, volumetrics.eye.xyz, direction, inside.x, inside.y, radius, MOST_GRID_SAMPLES);
        depth += local_sigma_t(local) * (density * (inside.y - inside.x));
    }
    return depth;
}

Medium particle_medium(vec3 point) {
    count_work(WORK_MEDIUM_SAMPLES, 1u);
    if (medium < 0) return global_medium(point.y, 0.0, 1.0);
    LocalMedium local = local_media[medium];
    float density = local_density(local, point);
    Medium m;
    m.sigma_s = local.sigma_s_g.rgb * density;
    m.anisotropy = local.sigma_s_g.w;
    m.emission = local.emission_noise.rgb * density;
    m.optical_depth = local_sigma_t(local) * density;  // of one metre
    m.sigma_s_rayleigh = vec3(0.0);
    return m;
}

// What the lamps make of one metre of the medium, seen from the front of [begin, end] of the ray.
vec3 lamp_light(Ray ray, float begin, float end, Medium m) {
#if LAMPS == 2
    // Over the particle's diameter: a lamp in it or beside it does not make it a firefly.
    vec3 sigma_s = medium < 0 ? volumetrics.homogeneous_sigma_s.rgb : m.sigma_s;
    vec3 unshadowed;
    Segment segment = Segment(begin, end, 0.5, m.anisotropy, sigma_s, volumetrics.homogeneous_sigma_t.rgb);
    expect_lamps(ray, begin, end, 1u);
    vec3 light = lamps_over_segment(ray, segment, unshadowed) / (end - begin);
    if (medium < 0) return light;
    // The height media that it adds are other particles'.
    float y = ray.origin.y + ray.direction.y * 0.5 * (begin + end);
    return light * m.sigma_s / max(m.sigma_s + height_sigma_s(y), 1.0e-30);
#else
    return vec3(0.0);
#endif
}

ParticleSprite lit_particle(vec3 center, vec4 clip, float share) {
    float distance = max(length(center), 1.0e-4);
    vec2 uv = clip.w > 1.0e-4 ? clamp(0.5 * clip.xy / clip.w + 0.5, 0.0, 1.0) : vec2(0.5);
    vec3 direction = center / distance;
    Ray ray = Ray(volumetrics.eye.xyz, direction, max(clip.w / distance, 0.01), uv, direction);
    float begin = max(distance - radius, 0.0);
    float end = distance + radius;
    vec3 point = ray.origin + center;
    Medium m = particle_medium(point);

    vec3 global_depth = volumetrics.homogeneous_sigma_t.rgb * begin + height_optical_depth(ray.origin.y, ray.direction.y, begin);
    // Local media may begin or end within the diameter of a global one's particle.
    int samples = medium < 0 ? 3 : 1;
    vec3 local_transmittance = vec3(0.0);
    for (int i = 0; i < samples; ++i) {
        float t = medium < 0 ? mix(begin, end, (float(i) + 0.5) / 3.0) : begin;
        local_transmittance += exp(-local_optical_depth(ray.direction, t)) / float(samples);
    }
    vec3 sigma_t = m.optical_depth;
    if (medium >= 0 && volumetrics.has_global != 0u) sigma_t += global_medium(point.y, 0.0, 1.0).optical_depth;
    MediumSegment diameter = integrate_segment(min(sigma_t * (end - begin), MAX_OPTICAL_DEPTH), 1.0);
    Extinction front = exp(-to_extinction(global_depth)) * to_extinction(local_transmittance);
    Extinction through = to_extinction(diameter.effective_length);

    vec3 ambient = volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
    vec3 light = m.sigma_s * ambient;
    if (medium >= 0) light += m.emission;
#if HAS_SUN
    Visibility visible = sun_visibility_at(point, distance * ray.forward_cosine);
    light += visible * exp(-(sun_optical_depth(point.y, -sun_direction()) + local_sun_optical_depth(point))) * sun_scattering(ray, m, Extinction(1.0));
#endif
    light = light * through + lamp_light(ray, begin, end, m);

    // What the sum over the particles of a pixel is known for, see particles_resolve.frag.
    MediumSegment own = integrate_segment(min(m.optical_depth * (end - begin), MAX_OPTICAL_DEPTH), 1.0);
    vec3 certain = medium < 0 ? m.sigma_s * exp(-global_depth) : m.optical_depth * local_transmittance;
    float scale = volume * share;
    light *= front;
    if (any(isnan(light)) || any(isinf(light))) light = vec3(0.0);  // of densities that no number holds
    ParticleSprite particle;
    particle.center_radius = vec4(center, radius);
    certain *= scale * own.effective_length;
    particle.light = vec4(scale * light, mean_channel(certain));
    particle.certain = vec4(certain, medium < 0 ? 0.0 : 1.0);
    return particle;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    vec3 center = vec3(0.0);
    float share = 1.0;
    if (medium < 0) {
        center = lattice_particle(index);
        vec3 along_axes = abs(center);
        float distance = max(along_axes.x, max(along_axes.y, along_axes.z));
        share = level_share(distance, reach.y) - level_share(distance, reach.x);
    } else {
        center = shape_particle(local_media[medium], index);
    }
    vec4 clip = view_projection * vec4(center, 1.0);
    ParticleSprite particle = ParticleSprite(vec4(0.0), vec4(0.0), vec4(0.0));
    if (share > 0.0 && in_view(center, clip)) particle = lit_particle(center, clip, share);
    particles[first + index] = particle;
    flush_work();
}
