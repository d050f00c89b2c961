// Where a pixel samples inside each of its segments: settings noise, noise_size and noise_time.
#ifndef VOLUMETRICS_NOISE_OFFSET_GLSL
#define VOLUMETRICS_NOISE_OFFSET_GLSL

#include "shaders/volumetrics/data.glsl"

layout(std430, binding = BINDING_NOISE) readonly buffer NoiseBuffer { float noise_offsets[]; };

// 0..1, as a share of the segment.
float noise_offset(uvec2 pixel) {
    uint side = volumetrics.counts.w;
    uvec2 cell = pixel % side;
    return noise_offsets[cell.x + side * cell.y];
}

#endif
