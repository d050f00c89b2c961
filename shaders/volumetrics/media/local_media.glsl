// The local media themselves, at any point.
#ifndef VOLUMETRICS_LOCAL_MEDIA_GLSL
#define VOLUMETRICS_LOCAL_MEDIA_GLSL

#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/media/shape.glsl"

layout(std430, binding = BINDING_LOCAL_MEDIA) readonly buffer LocalMediaBuffer { LocalMedium local_media[]; };

vec3 to_shape(LocalMedium medium, vec3 point) { return (medium.world_to_shape * vec4(point, 1.0)).xyz; }

float local_density(LocalMedium medium, vec3 point) {
    vec3 p = to_shape(medium, point);
    float density = shape_density(medium, p);
    if (density <= 0.0) return 0.0;
    if (medium.emission_noise.w > 0.0)
        density *= media_noise(p, medium.noise_height.x, medium.emission_noise.w, uint(medium.noise_height.y));
    return density * media_height(point.y, medium.noise_height.z, medium.noise_height.w);
}

// Inside the shape the density is 1 everywhere.
bool is_homogeneous(LocalMedium medium) {
    return shape_is_even(medium) && medium.emission_noise.w <= 0.0 && medium.noise_height.w <= 0.0;
}

// The part of [begin, end] of a line in the shape, metres along the unit direction; none: x >= y.
vec2 inside_shape(LocalMedium medium, vec3 origin, vec3 direction, float begin, float end) {
    vec2 chord = shape_chord(medium, to_shape(medium, origin), mat3(medium.world_to_shape) * direction);
    return vec2(max(chord.x, begin), min(chord.y, end));
}

#endif
