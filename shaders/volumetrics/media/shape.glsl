// What is asked of a local medium's shape, in its own frame: metres from its centre, turned by the inverse of its rotation,
// not scaled. Each shape answers in a file of its own, and has a line in each function here; C++'s part is
// modules/volumetrics/src/media/shape.h. extent_softness.xyz is half the size of the box round the shape.
//
// C++ reads these files too (shaders/lib/glm_subset.h), given shaders/shared/volumetrics.h and the name LocalMedium.
#ifndef VOLUMETRICS_SHAPE_GLSL
#define VOLUMETRICS_SHAPE_GLSL

#include "shaders/lib/media_density.glsl"
#include "shaders/volumetrics/media/shape_box.glsl"
#include "shaders/volumetrics/media/shape_ellipsoid.glsl"

int shape_of(LocalMedium medium) { return int(medium.sigma_a_shape.w); }
// A grid fills its box: what of it is empty is a matter of its density.
bool is_box(LocalMedium medium) { return shape_of(medium) != SHAPE_ELLIPSOID; }

// Of a sphere round the centre that holds it, m.
float shape_radius(LocalMedium medium) { return length(vec3(medium.extent_softness)); }

// Distance from the rim to a point inside, m; negative outside.
float shape_depth(LocalMedium medium, vec3 p) {
    vec3 extent = vec3(medium.extent_softness);
    if (is_box(medium)) {
        return box_depth(p, extent);
    }
    return ellipsoid_depth(p, extent);
}

// 0..1, apart from noise, height and grid.
float shape_density(LocalMedium medium, vec3 p) { return soft_rim(shape_depth(medium, p), medium.extent_softness.w); }

// That is 1 everywhere inside.
bool shape_is_even(LocalMedium medium) { return medium.extent_softness.w <= 0.0f; }

// The part of the line o + d t inside; none: x >= y.
vec2 shape_chord(LocalMedium medium, vec3 o, vec3 d) {
    vec3 extent = vec3(medium.extent_softness);
    if (any(lessThanEqual(extent, vec3(0.0f)))) {
        return vec2(0.0f);
    }
    if (is_box(medium)) {
        return box_chord(o, d, extent);
    }
    return ellipsoid_chord(o, d, extent);
}

// Points spread evenly over the unit cube are, as these points, spread evenly over the shape. They move by `drift` metres
// and stay inside.
vec3 shape_place(LocalMedium medium, vec3 u, float drift) {
    vec3 extent = vec3(medium.extent_softness);
    if (is_box(medium)) {
        return box_place(u, drift, extent);
    }
    return ellipsoid_place(u, drift, extent);
}

#endif
