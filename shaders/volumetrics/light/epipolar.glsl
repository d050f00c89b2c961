// Which parts of a view ray a light reaches, from rectified shadow maps with min/max trees: Chen, Baran, Durand and Jarosz,
// "Real-Time Volumetric Shadows using 1D Min-Max Mipmaps" (2011), along epipolar lines.
//
// A plane through eye and light holds view rays and light rays. Each of its light rays ends at its first occluder; as one
// follows it from the light to there, its angle to the axis from the eye towards the light, as seen from the eye, rises.
// So a view ray at the angle a is lit where it crosses a light ray if a <= the angle at which that one ends, or
//     cot(a) >= (distance along the axis) / (distance from the axis) of that end, both from the eye:
// one slope for the whole view ray against one stored number for each light ray. A line of the map holds the light rays
// ("cells") of one half plane in the order in which view rays cross them, and a tree of their smallest and largest slopes.
// A view ray takes whole nodes where its slope is beyond both.
//
// Cells: of a sun, in proportion to log(1 + radius / 2 m) of the light ray's distance from the axis; of a lamp, in
// proportion to its angle at the lamp to the direction of the eye, which for what a view ray gathers of inverse squares
// are equal shares.
#ifndef VOLUMETRICS_EPIPOLAR_GLSL
#define VOLUMETRICS_EPIPOLAR_GLSL

#include "shaders/lib/work.glsl"

const float EPIPOLAR_RADIUS = 2.0;        // m
const float EPIPOLAR_LARGEST = 1.0e9;     // slope
const int EPIPOLAR_ROW_BITS = 12;         // 4096 texels a row of a texture
const float EPIPOLAR_TWO_PI = 6.28318531;

// The lines of one light (modules/volumetrics/src/light/epipolar.h): light 0 is the sun, 1 + i lamp i.
struct EpipolarLines {
    vec3 axis;         // unit, from the eye to the light
    float distance;    // of the lamp, m; 0: parallel light
    vec3 first;        // unit, across the axis: the angle 0
    float lines_per_radian;
    float cells_per_unit;  // of log(1 + radius / 2 m), or of radians
    int lines;
    int cells;         // a line, a power of two; 0: the light has no lines
    int nodes;         // index of the first line's
    int samples;       // along each line (epipolar_samples.glsl)
    float first_sample;
    float samples_per_radian;
};

// Of parallel light the place among the cells of what is so far (m) from the axis.
float epipolar_sun_place(EpipolarLines lines, float radius) {
    return log(1.0 + radius / EPIPOLAR_RADIUS) * lines.cells_per_unit;
}

// Where the i-th entry of a list lies in its texture.
ivec2 epipolar_texel(int i) { return ivec2(i & ((1 << EPIPOLAR_ROW_BITS) - 1), i >> EPIPOLAR_ROW_BITS); }

EpipolarLines epipolar_lines(sampler2D table, int light) {
    vec4 a = texelFetch(table, epipolar_texel(4 * light), 0);
    vec4 b = texelFetch(table, epipolar_texel(4 * light + 1), 0);
    vec4 c = texelFetch(table, epipolar_texel(4 * light + 2), 0);
    vec4 d = texelFetch(table, epipolar_texel(4 * light + 3), 0);
    return EpipolarLines(a.xyz, a.w, b.xyz, b.w, c.x, int(c.y), int(c.z), int(c.w), int(d.z), d.x, d.y);
}

// Where a direction lies among the lines: 0.5 in the middle of the first one.
float epipolar_line(EpipolarLines lines, vec3 across) {
    float angle = atan(dot(across, cross(lines.axis, lines.first)), dot(across, lines.first));
    if (angle < 0.0) angle += EPIPOLAR_TWO_PI;
    return angle * lines.lines_per_radian;
}

#endif
