#ifndef TYNDALL_LIB_SAMPLING_NOISE
#define TYNDALL_LIB_SAMPLING_NOISE

#include "shaders/lib/noise.glsl"

// Where a ray takes its samples inside its segments, by pixel and frame, as a fraction of a segment: always in the open
// interval (0, 1), so that no sample lies on a border. Fractions are kept as 32-bit integers, a fraction f as
// floor(f 2^32): sums and products wrap as fract() does, and nothing is lost at pixel 4,000 or frame 4,000,000,000.

// The middle of one of 2^23 equal parts of (0, 1), exact in single precision.
float open_unit_float(uint fraction) {
    return (float(fraction >> 9u) + 0.5f) * (1.0f / 8388608.0f);
}

// Rank 0..n^2-1 in the Bayer index matrix of size n = 1, 2, 4, 8 or 16: bit_reverse(bit_interleave(x ^ y, y)). The
// lowest bits of the coordinates give the highest two bits of the rank: every aligned 2^k x 2^k block holds one rank
// of each of 4^k equal ranges.
uint bayer_rank(uvec2 pixel, uint size) {
    uint differ = pixel.x ^ pixel.y;
    uint rank = 0u;
    for (uint bit = 1u; bit < size; bit <<= 1u) {
        rank = (rank << 2u) | ((differ & bit) != 0u ? 2u : 0u) | ((pixel.y & bit) != 0u ? 1u : 0u);
    }
    return rank;
}

float white_offset(uvec2 pixel, uint frame) {
    return open_unit_float(hash_uvec3(uvec3(pixel.x, pixel.y, frame), 0u));
}

// Interleaved gradient noise (Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", 2014):
// fract(52.9829189 fract(0.06711056 x + 0.00583715 y)), in which any 3 x 3 pixels have nearly the nine ninths. x and y
// are shifted by 5.588238 (frame mod 64).
float interleaved_gradient_offset(uvec2 pixel, uint frame) {
    const uint by_x = 288237660u;       // 0.06711056
    const uint by_y = 25070368u;        // 0.00583715
    const uint by_frame = 1750839832u;  // fract(5.588238 (0.06711056 + 0.00583715))
    uint inner = by_x * pixel.x + by_y * pixel.y + by_frame * (frame & 63u);
    uint rest = uint(0.9829189f * float(inner >> 8u)) << 8u;
    return open_unit_float(52u * inner + rest);
}

// offset + frame times the golden ratio's fraction, modulo 1: over any number of frames the offsets of a pixel are
// spread evenly.
float golden_ratio_offset(float offset, uint frame) {
    return open_unit_float((uint(offset * 16777216.0f) << 8u) + 2654435769u * frame);
}

// In pixels, 0..period-1: frame times (1/p, 1/p^2), p^3 = p + 1, modulo 1 (Roberts' sequence R2), times the period
// of a pattern, at most 65,536. Over the frames a pixel comes to every place of the pattern equally often.
uvec2 r2_shift(uint frame, uint period) {
    uvec2 fraction = uvec2(3242174889u * frame, 2447445413u * frame);
    return uvec2(((fraction.x >> 16u) * period) >> 16u, ((fraction.y >> 16u) * period) >> 16u);
}

#endif
