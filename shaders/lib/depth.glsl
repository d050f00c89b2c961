#ifndef TYNDALL_LIB_DEPTH
#define TYNDALL_LIB_DEPTH

// Reversed-Z depth buffer with an infinite far plane: 1 at the near plane, 0 at infinity.
// View depth [m] is the distance along the camera's forward axis (-z of view space), not along the ray.

// View depth of what is infinitely far; finite, so that its square and its product with a direction are too.
const float MAX_VIEW_DEPTH = 1.0e9f;

// view_depth = z_near / depth, at most MAX_VIEW_DEPTH.
float view_depth_from_buffer(float depth, float z_near) {
    return z_near / max(depth, z_near / MAX_VIEW_DEPTH);
}

float buffer_from_view_depth(float view_depth, float z_near) {
    return z_near / view_depth;
}

// Nothing was drawn here: the sky shows.
bool is_background(float depth) {
    return depth <= 0.0f;
}

// Distance along a ray at a view depth; forward_cosine is the dot product of the unit ray and the camera's
// forward axis.
float ray_distance_from_view_depth(float view_depth, float forward_cosine) {
    return view_depth / forward_cosine;
}

// View-space point of normalised device coordinates (-1..1, y up) at a view depth, for a symmetric perspective
// whose tan_half_fov holds the tangents of half the horizontal and half the vertical field of view.
vec3 view_position_from_ndc(vec2 ndc, float view_depth, vec2 tan_half_fov) {
    return vec3(ndc * tan_half_fov * view_depth, -view_depth);
}

// The inverse, for view_position.z < 0: NDC in xy, view depth in z.
vec3 ndc_from_view_position(vec3 view_position, vec2 tan_half_fov) {
    float view_depth = -view_position.z;
    return vec3(view_position.x / (tan_half_fov.x * view_depth), view_position.y / (tan_half_fov.y * view_depth),
                view_depth);
}

#endif
