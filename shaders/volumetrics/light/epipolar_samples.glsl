// Samples of the sunlight along the sun's lines, a texel each: x along the line, y the line. They lie at fixed angles to the
// axis, about as far apart as the lines; what each stands for is its ray up to the surface of the pixel it falls in.
#ifndef VOLUMETRICS_EPIPOLAR_SAMPLES_GLSL
#define VOLUMETRICS_EPIPOLAR_SAMPLES_GLSL

#include "shaders/lib/depth.glsl"
#include "shaders/volumetrics/frame/data.glsl"
#include "shaders/volumetrics/light/epipolar.glsl"

uniform mat4 to_pixel;  // of a direction; xy / z
uniform float tolerance;

const float NOT_SEEN = -1.0;  // 1/m: what is not in the picture

vec3 sample_direction(EpipolarLines lines, ivec2 at) {
    float round_axis = (float(at.y) + 0.5) / lines.lines_per_radian;
    vec3 across = cos(round_axis) * lines.first + sin(round_axis) * cross(lines.axis, lines.first);
    float off_axis = (float(at.x) + lines.first_sample) / lines.samples_per_radian;
    return cos(off_axis) * lines.axis + sin(off_axis) * across;
}

float forward_cosine(vec3 direction) { return -dot(volumetrics.inverse_view[2].xyz, direction); }

// The pixel a direction falls in; x < 0: none.
ivec2 seen_pixel(vec3 direction) {
    vec3 p = (to_pixel * vec4(direction, 0.0)).xyz;
    vec2 pixel = p.xy / max(p.z, 1.0e-6);
    bool seen = p.z > 0.0 && all(greaterThanEqual(pixel, vec2(0.0))) && all(lessThan(pixel, volumetrics.target.xy));
    return seen ? ivec2(pixel) : ivec2(-1);
}

// 1 / distance (1/m) of the surface in a direction: linear over the picture of a plane. 0: infinitely far.
float inverse_distance(float depth, vec3 direction) {
    return is_background(depth) ? 0.0 : forward_cosine(direction) / view_depth_from_buffer(depth, volumetrics.eye.w);
}

// Largest difference (1/m) of inverse distances that are taken for one surface.
float same_surface(float inverse) { return tolerance * (inverse + 1.0 / volumetrics.max_distance); }

#endif
