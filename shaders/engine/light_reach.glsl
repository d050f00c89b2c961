// What a lamp can reach, in the subset of GLSL that C++ compiles too (shaders/lib/glm_subset.h).
#ifndef ENGINE_LIGHT_REACH_GLSL
#define ENGINE_LIGHT_REACH_GLSL

// Cosine of a spot's outer half angle, from its law clamp(cos * scale + offset, 0, 1)^2.
float cone_cosine(vec2 scale_offset) {
    return clamp(-scale_offset.y / scale_offset.x, -1.0f, 1.0f);
}

// Smallest sphere (xyz centre, w radius) around a spherical sector: apex, unit axis, range, and the cosine of its half
// angle. Up to 45 degrees it passes through the apex and the rim, beyond that the rim is a great circle.
vec4 cone_reach(vec3 apex, vec3 axis, float range, float cosine) {
    if (cosine <= 0.0f) {
        return vec4(apex, range);
    }
    if (cosine < 0.70710678f) {
        return vec4(apex + axis * (range * cosine), range * sqrt(1.0f - cosine * cosine));
    }
    float radius = 0.5f * range / cosine;
    return vec4(apex + axis * radius, radius);
}

// Whether a sphere may meet a spherical sector; never false when it does.
bool cone_meets_sphere(vec3 apex, vec3 axis, float range, float cosine, vec3 center, float radius) {
    vec3 to_center = center - apex;
    float along = dot(to_center, axis);
    float across = sqrt(max(dot(to_center, to_center) - along * along, 0.0f));
    float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
    // Signed distance from the cone's surface; behind the apex of an acute cone the distance to it is more still.
    float outside = across * cosine - along * sine;
    return outside <= radius && along <= range + radius && (cosine < 0.0f || along >= -radius);
}

// What a sphere (view space: x right, y up, -z forward) covers of the screen, in NDC, and of view depth (m); a sphere
// around the eye covers all of the screen. tan_half_fov: of half the horizontal and half the vertical field of view.
struct ScreenBounds {
    vec2 lo;
    vec2 hi;
    float near;
    float far;
};

// Slopes (x / depth) of the two lines through the eye that touch a circle at (x, depth); -+1e9 where a line does not go
// forwards. Rotating the direction of the centre by +-asin(r / distance) gives them.
vec2 tangent_slopes(float x, float depth, float radius) {
    float t2 = x * x + depth * depth - radius * radius;
    if (t2 <= 0.0f) {
        return vec2(-1.0e9f, 1.0e9f);
    }
    float t = sqrt(t2);
    float lo_depth = depth * t + x * radius;
    float hi_depth = depth * t - x * radius;
    return vec2(lo_depth > 0.0f ? (x * t - depth * radius) / lo_depth : -1.0e9f,
                hi_depth > 0.0f ? (x * t + depth * radius) / hi_depth : 1.0e9f);
}

ScreenBounds screen_bounds(vec3 center, float radius, vec2 tan_half_fov) {
    float depth = -center.z;
    vec2 x = tangent_slopes(center.x, depth, radius);
    vec2 y = tangent_slopes(center.y, depth, radius);
    ScreenBounds bounds;
    bounds.lo = vec2(x.x / tan_half_fov.x, y.x / tan_half_fov.y);
    bounds.hi = vec2(x.y / tan_half_fov.x, y.y / tan_half_fov.y);
    bounds.near = depth - radius;
    bounds.far = depth + radius;
    return bounds;
}

#endif
