// Where a direction from a lamp lies in the lamp's tile of the atlas, and the inverse. Two maps: all directions
// octahedrally; or, where the lamp or the media need no more, those round an axis in perspective.
#ifndef VOLUMETRICS_LIGHT_VOLUME_GLSL
#define VOLUMETRICS_LIGHT_VOLUME_GLSL

#include "shaders/lib/octahedral.glsl"

// A unit axis and two directions across it (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
mat3 basis_round(vec3 axis) {
    float s = axis.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + axis.z);
    float b = axis.x * axis.y * a;
    return mat3(vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x), vec3(b, s + axis.y * axis.y * a, -axis.y),
                axis);
}

// window: xyz its axis, w 1 / tangent of half its opening; w = 0: all directions. Gives the place on the tile, 0..1
// without its border; outside of that the direction is not in the window.
vec2 lamp_tile_place(vec3 direction, vec4 window) {
    if (window.w == 0.0) return octahedral_encode(direction);
    vec3 p = direction * basis_round(window.xyz);
    if (p.z <= 1.0e-4) return vec2(-1.0e3);
    return 0.5 + 0.5 * window.w * p.xy / p.z;
}

// Also of places in the border: an octahedral map goes on over an edge of its square with the point mirrored on that
// edge's middle.
vec3 lamp_tile_direction(vec2 place, vec4 window) {
    if (window.w == 0.0) {
        if (place.x < 0.0 || place.x > 1.0) place = vec2(place.x < 0.0 ? -place.x : 2.0 - place.x, 1.0 - place.y);
        if (place.y < 0.0 || place.y > 1.0) place = vec2(1.0 - place.x, place.y < 0.0 ? -place.y : 2.0 - place.y);
        return octahedral_decode(place);
    }
    return normalize(basis_round(window.xyz) * vec3((2.0 * place - 1.0) / window.w, 1.0));
}

#endif
