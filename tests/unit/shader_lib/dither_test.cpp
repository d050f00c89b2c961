#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/dither.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;
using glm::uint;
using glm::uvec2;

TEST(Bayer, MatchesTheRecursiveDefinition) {
    // M_2n = [[4 M, 4 M + 2], [4 M + 3, 4 M + 1]], from M_1 = [0]; rows are y.
    std::vector<uint> matrix{0u};
    for (uint size = 1u; size <= 16u; size *= 2u) {
        for (uint y = 0u; y < size; ++y) {
            for (uint x = 0u; x < size; ++x) {
                ASSERT_EQ(glsl::bayer_rank(uvec2(x, y), size), matrix[y * size + x])
                    << size << " " << x << " " << y;
                ASSERT_EQ(glsl::bayer_rank(uvec2(x + 3u * size, y + size), size), matrix[y * size + x]);
            }
        }
        std::vector<uint> next(4u * size * size);
        const uint corner[2][2] = {{0u, 2u}, {3u, 1u}};
        for (uint y = 0u; y < 2u * size; ++y) {
            for (uint x = 0u; x < 2u * size; ++x) {
                next[y * 2u * size + x] = 4u * matrix[(y % size) * size + x % size] + corner[y / size][x / size];
            }
        }
        matrix = next;
    }
}

TEST(Bayer, EveryAlignedBlockHoldsOneRankOfEachRange) {
    for (uint size : {2u, 4u, 8u, 16u}) {
        for (uint block = 2u; block <= size; block *= 2u) {
            const uint ranks_per_range = size * size / (block * block);
            for (uint y0 = 0u; y0 < size; y0 += block) {
                for (uint x0 = 0u; x0 < size; x0 += block) {
                    std::set<uint> ranges;
                    for (uint i = 0u; i < block * block; ++i) {
                        const uint rank = glsl::bayer_rank(uvec2(x0 + i % block, y0 + i / block), size);
                        ASSERT_LT(rank, size * size);
                        ranges.insert(rank / ranks_per_range);
                    }
                    ASSERT_EQ(ranges.size(), block * block) << size << " " << block;
                }
            }
        }
    }
}

TEST(White, IsAPermutationOfTheTile) {
    for (uint size : {1u, 2u, 4u, 8u, 16u}) {
        for (uint seed = 0u; seed < 50u; ++seed) {
            std::set<uint> ranks;
            for (uint i = 0u; i < size * size; ++i) {
                const uint rank = glsl::white_rank(uvec2(i % size + size, i / size), size, seed);
                ASSERT_LT(rank, size * size);
                ranks.insert(rank);
            }
            ASSERT_EQ(ranks.size(), size * size);
        }
    }
}

// As for shuffled arrays: over many seeds a place is equally likely to get each rank, and neighbours are as little
// correlated as a permutation of n^2 can be, -1 / (n^2 - 1).
TEST(White, IsUniformAndUncorrelatedOverSeeds) {
    const uint size = 8u;
    const int seeds = 4000;
    std::vector<int> at_origin(64, 0);
    double right = 0.0, down = 0.0, two = 0.0, diagonal = 0.0, variance = 0.0;
    for (uint seed = 0u; seed < seeds; ++seed) {
        const auto centred = [&](uint x, uint y) { return glsl::white_rank(uvec2(x, y), size, seed) - 31.5; };
        ++at_origin[glsl::white_rank(uvec2(0u, 0u), size, seed)];
        for (uint y = 0u; y < size; ++y) {
            for (uint x = 0u; x < size; ++x) {
                variance += centred(x, y) * centred(x, y);
                right += centred(x, y) * centred(x + 1u, y);
                down += centred(x, y) * centred(x, y + 1u);
                two += centred(x, y) * centred(x + 2u, y);
                diagonal += centred(x, y) * centred(x + 1u, y + 1u);
            }
        }
    }
    for (double correlation : {right, down, two, diagonal}) {
        EXPECT_NEAR(correlation / variance, -1.0 / 63.0, 0.02);
    }
    double chi_square = 0.0;
    for (int count : at_origin) {
        chi_square += std::pow(count - seeds / 64.0, 2) / (seeds / 64.0);
    }
    EXPECT_LT(chi_square, 63.0 + 4.0 * std::sqrt(126.0));
}

TEST(Dither, OffsetsAreTheMiddlesOfEqualStrata) {
    for (int kind : {glsl::DITHER_WHITE, glsl::DITHER_BAYER}) {
        for (uint size : {1u, 2u, 4u, 8u, 16u}) {
            double sum = 0.0;
            std::set<int> strata;
            const uint count = size * size;
            for (uint i = 0u; i < count; ++i) {
                const float offset = glsl::dither_offset(kind, uvec2(i % size, i / size), size, 1u);
                EXPECT_TRUE(offset > 0.0f && offset < 1.0f);
                sum += offset;
                const float stratum = offset * static_cast<float>(count) - 0.5f;
                EXPECT_EQ(stratum, std::floor(stratum));
                strata.insert(static_cast<int>(stratum));
            }
            EXPECT_DOUBLE_EQ(sum / count, 0.5);
            EXPECT_EQ(strata.size(), count);
        }
    }
    EXPECT_EQ(glsl::dither_offset(glsl::DITHER_NONE, uvec2(3u, 5u), 8u, 1u), 0.5f);
}

}  // namespace
