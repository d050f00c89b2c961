// Where a pixel samples inside each of its segments: settings noise, noise_size and noise_time. How the settings become
// volumetrics.noise: noise_uniform() in modules/volumetrics/src/reconstruction/noise.cpp.
#ifndef VOLUMETRICS_NOISE_OFFSET_GLSL
#define VOLUMETRICS_NOISE_OFFSET_GLSL

#include "shaders/lib/sampling_noise.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(std140, binding = BINDING_NOISE) uniform NoiseBlock { vec4 noise_offsets[NOISE_TILE_OFFSETS / 4]; };  // of bayer, white_tile
layout(binding = UNIT_NOISE) uniform sampler2DArray noise_texture;                                            // of blue, stbn, fast

// Of a texture; NOISE_WHITE and NOISE_IGN, which have none, are shifted by up to as much.
const uint NOISE_PERIOD = uint(NOISE_TEXTURE_SIDE);

float noise_at(int kind, uvec2 pixel, uint frame) {
    if (kind == NOISE_NONE) return 0.5;
    if (kind == NOISE_WHITE) return white_offset(pixel, frame);
    if (kind == NOISE_IGN) return interleaved_gradient_offset(pixel, frame);
    if (kind == NOISE_BAYER || kind == NOISE_WHITE_TILE) {
        uvec2 cell = pixel % volumetrics.noise_side;
        uint i = cell.x + volumetrics.noise_side * cell.y;
        return noise_offsets[i / 4u][i % 4u];
    }
    count_work(WORK_TEXTURE_FETCHES, 1u);
    ivec3 texel = ivec3(pixel % NOISE_PERIOD, frame % uint(NOISE_TEXTURE_SLICES));
    return (texelFetch(noise_texture, texel, 0).r * 255.0 + 0.5) / 256.0;
}

// As a share of the segment, in the open interval (0, 1).
float noise_offset(uvec2 pixel) {
    int kind = int(volumetrics.noise.x), time = int(volumetrics.noise.y);
    uint frame = volumetrics.noise.z;
    if (time == NOISE_TIME_R2) pixel += r2_shift(frame, volumetrics.noise_side > 1u ? volumetrics.noise_side : NOISE_PERIOD);
    float offset = noise_at(kind, pixel, time == NOISE_TIME_OWN ? frame : 0u);
    return time == NOISE_TIME_GOLDEN_RATIO ? golden_ratio_offset(offset, frame) : offset;
}

#endif
