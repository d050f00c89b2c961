// The local media themselves, at any point.
#ifndef VOLUMETRICS_LOCAL_MEDIA_GLSL
#define VOLUMETRICS_LOCAL_MEDIA_GLSL

#include "shaders/lib/media_shape.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(std430, binding = BINDING_LOCAL_MEDIA) readonly buffer LocalMediaBuffer { LocalMedium local_media[]; };

float local_density(LocalMedium medium, vec3 point) {
    vec3 p = (medium.world_to_shape * vec4(point, 1.0)).xyz;
    vec3 extent = medium.extent_softness.xyz;
    float softness = medium.extent_softness.w;
    float density = int(medium.sigma_a_shape.w) == SHAPE_BOX ? box_density(p, extent, softness)
                                                             : ellipsoid_density(p, extent, softness);
    if (density <= 0.0) return 0.0;
    if (medium.emission_noise.w > 0.0)
        density *= media_noise(p, medium.noise_height.x, medium.emission_noise.w, uint(medium.noise_height.y));
    return density * media_height(point.y, medium.noise_height.z, medium.noise_height.w);
}

// Inside the shape the density is 1 everywhere.
bool is_homogeneous(LocalMedium medium) {
    return medium.extent_softness.w <= 0.0 && medium.emission_noise.w <= 0.0 && medium.noise_height.w <= 0.0;
}

// The part of [begin, end] of a line in the shape, metres along the unit direction; none: x >= y.
vec2 inside_shape(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end) {
    const vec2 OUTSIDE = vec2(0.0);
    vec3 o = (medium.world_to_shape * vec4(origin, 1.0)).xyz;
    vec3 d = mat3(medium.world_to_shape) * direction;
    vec3 extent = medium.extent_softness.xyz;
    if (any(lessThanEqual(extent, vec3(0.0)))) return OUTSIDE;
    vec2 inside;
    if (int(medium.sigma_a_shape.w) == SHAPE_BOX) {
        vec3 inverse = 1.0 / mix(d, vec3(1.0e-20), lessThan(abs(d), vec3(1.0e-20)));  // finite if parallel to a face
        vec3 p = (-extent - o) * inverse;
        vec3 q = (extent - o) * inverse;
        vec3 enter = min(p, q);
        vec3 leave = max(p, q);
        inside = vec2(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
    } else {
        // The sphere |o + d t| = 1 of the scaled line, from its point nearest to the centre.
        o /= extent;
        d /= extent;
        float length_squared = dot(d, d);
        float nearest = -dot(o, d) / length_squared;
        vec3 p = o + d * nearest;
        float depth = 1.0 - dot(p, p);
        if (depth <= 0.0) return OUTSIDE;
        float half_chord = sqrt(depth / length_squared);
        inside = nearest + vec2(-half_chord, half_chord);
    }
    return vec2(max(inside.x, begin), min(inside.y, end));
}

#endif
