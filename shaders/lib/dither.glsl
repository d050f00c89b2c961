#ifndef TYNDALL_LIB_DITHER
#define TYNDALL_LIB_DITHER

#include "shaders/lib/noise.glsl"

// Where a ray takes its sample inside each step, as a fraction of the step, by the pixel's place in an n x n tile.
// The n^2 ranks of a tile become (rank + 0.5) / n^2: the rays of a tile together sample n^2 equal strata at their
// middles, and their mean is 0.5, so no tile is biased. rank / n^2 would take the near end of each stratum: a shift
// of 1 / (2 n^2) steps towards the eye, an error of first order.

const int DITHER_NONE = 0;   // the middle of the step
const int DITHER_WHITE = 1;  // a pseudo-random permutation of the ranks
const int DITHER_BAYER = 2;  // ordered: every aligned 2^k x 2^k block holds one rank of each of 4^k equal ranges

// Rank 0..n^2-1 in the Bayer index matrix of size n = 1, 2, 4, 8 or 16: bit_reverse(bit_interleave(x ^ y, y)). The
// lowest bits of the coordinates give the highest two bits of the rank.
uint bayer_rank(uvec2 pixel, uint size) {
    uint differ = pixel.x ^ pixel.y;
    uint rank = 0u;
    for (uint bit = 1u; bit < size; bit <<= 1u) {
        rank = (rank << 2u) | ((differ & bit) != 0u ? 2u : 0u) | ((pixel.y & bit) != 0u ? 1u : 0u);
    }
    return rank;
}

// Rank 0..n^2-1 of a pixel in a white-noise tile of size n, a power of two up to 256: a permutation, as a shuffled
// array would be, but without the array. Each round is a bijection of the log2(n^2) bits of the pixel's index: an
// odd multiple, a sum, and a right shift folded in, all modulo n^2.
uint white_rank(uvec2 pixel, uint size, uint seed) {
    uint mask = size * size - 1u;
    uint index = ((pixel.y & (size - 1u)) * size + (pixel.x & (size - 1u))) & mask;
    uint key = seed;
    for (int i = 0; i < 6; ++i) {
        key = hash_uint(key);
        index = (index * (key | 1u) + (key >> 8u)) & mask;
        index ^= index >> (1u + (key >> 28u) % 3u);
        index = (index + (key >> 16u)) & mask;
    }
    return index;
}

// The offset in (0, 1); size as for the ranks.
float dither_offset(int kind, uvec2 pixel, uint size, uint seed) {
    if (kind == DITHER_NONE) {
        return 0.5f;
    }
    uint rank = kind == DITHER_BAYER ? bayer_rank(pixel, size) : white_rank(pixel, size, seed);
    return (float(rank) + 0.5f) / float(size * size);
}

#endif
