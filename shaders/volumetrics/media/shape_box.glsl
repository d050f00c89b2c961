#ifndef VOLUMETRICS_SHAPE_BOX_GLSL
#define VOLUMETRICS_SHAPE_BOX_GLSL

// Below the nearest face, m; negative outside.
float box_depth(vec3 p, vec3 half_size) {
    vec3 depth = half_size - abs(p);
    return min(depth.x, min(depth.y, depth.z));
}

vec2 box_chord(vec3 o, vec3 d, vec3 half_size) {
    vec3 inverse_d = 1.0f / mix(d, vec3(1.0e-20f), lessThan(abs(d), vec3(1.0e-20f)));  // finite if parallel to a face
    vec3 p = (-half_size - o) * inverse_d;
    vec3 q = (half_size - o) * inverse_d;
    vec3 enter = min(p, q);
    vec3 leave = max(p, q);
    return vec2(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

// It drifts along x and wraps round.
vec3 box_place(vec3 u, float drift, vec3 half_size) {
    u.x = fract(u.x + drift / (2.0f * half_size.x));
    return (2.0f * u - 1.0f) * half_size;
}

#endif
