#ifndef VOLUMETRICS_SHAPE_ELLIPSOID_GLSL
#define VOLUMETRICS_SHAPE_ELLIPSOID_GLSL

// Below the surface, m, along the gradient of k(p) = |p / radii|: (1 - k) / |grad k|, at most the smallest radius; negative
// outside. It is exact at the rim, on the axes and for a sphere; elsewhere it is too large, by less than 2.5% for axes in
// the ratio 1.5, 6% for 2 and 21% for 4 down to a depth of a quarter of the smallest radius, so a soft rim is that much
// steeper.
float ellipsoid_depth(vec3 p, vec3 radii) {
    vec3 q = p / radii;
    float k = length(q);
    float gradient = length(q / radii) / max(k, 1.0e-6f);
    float smallest = min(radii.x, min(radii.y, radii.z));
    return min((1.0f - k) / max(gradient, 1.0e-6f / smallest), smallest);
}

// The sphere |o + d t| = 1 of the scaled line, from its point nearest to the centre.
vec2 ellipsoid_chord(vec3 o, vec3 d, vec3 radii) {
    o /= radii;
    d /= radii;
    float length_squared = dot(d, d);
    float nearest = -dot(o, d) / length_squared;
    vec3 p = o + d * nearest;
    float depth = 1.0f - dot(p, p);
    if (depth <= 0.0f) {
        return vec2(0.0f);
    }
    float half_chord = sqrt(depth / length_squared);
    return nearest + vec2(-half_chord, half_chord);
}

// It turns about y.
vec3 ellipsoid_place(vec3 u, float drift, vec3 radii) {
    const float TURN = 6.28318530717959f;
    float angle = TURN * u.z + drift / max(radii.x, radii.z);
    float height = 1.0f - 2.0f * u.y;
    float ring = sqrt(max(1.0f - height * height, 0.0f));
    return pow(u.x, 1.0f / 3.0f) * vec3(ring * cos(angle), height, ring * sin(angle)) * radii;
}

#endif
