#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/sampling_noise.glsl"
TYNDALL_GLSL_END

namespace {

using namespace tyndall;
using glm::uint;
using glm::uvec2;

double fract(double x) {
    return x - std::floor(x);
}
/// Of two fractions, on a circle of circumference 1.
double distance(double a, double b) {
    const double d = fract(a - b);
    return std::min(d, 1 - d);
}

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

TEST(SamplingNoise, FractionsAreNeverZeroOrOne) {
    EXPECT_GT(glsl::open_unit_float(0u), 0.0f);
    EXPECT_LT(glsl::open_unit_float(0xffffffffu), 1.0f);
    // The formula gives 0 here.
    EXPECT_GT(glsl::interleaved_gradient_offset(uvec2(0u), 0u), 0.0f);
    for (const float offset : {1e-7f, 0.5f / 256.0f, 0.25f, 0.99999994f}) {
        EXPECT_NEAR(glsl::golden_ratio_offset(offset, 0u), offset, 1e-6);
        EXPECT_GT(glsl::golden_ratio_offset(offset, 0u), 0.0f);
        EXPECT_LT(glsl::golden_ratio_offset(offset, 0u), 1.0f);
    }
}

TEST(White, IsUniformAndPixelsAndFramesAreIndependent) {
    const uint side = 128u, frames = 8u;
    const auto at = [&](uint x, uint y, uint frame) { return glsl::white_offset(uvec2(x, y), frame); };
    std::vector<int> counts(64, 0);
    std::map<std::vector<uint>, double> correlations{{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{1, 1, 0}, 0},
                                                     {{2, 0, 0}, 0}, {{8, 0, 0}, 0}, {{0, 0, 1}, 0},
                                                     {{0, 0, 2}, 0}, {{1, 0, 1}, 0}, {{128, 0, 0}, 0}};
    for (uint frame = 0u; frame < frames; ++frame)
        for (uint y = 0u; y < side; ++y)
            for (uint x = 0u; x < side; ++x) {
                const double v = at(x, y, frame);
                ++counts[static_cast<std::size_t>(v * 64)];
                for (auto& [d, sum] : correlations) sum += (v - 0.5) * (at(x + d[0], y + d[1], frame + d[2]) - 0.5);
            }
    const double n = side * side * frames;
    // Of independent values: 0 with a standard deviation of n^-1/2 = 0.003.
    for (const auto& [d, sum] : correlations) EXPECT_NEAR(12 * sum / n, 0, 0.012) << d[0] << d[1] << d[2];
    double chi_square = 0;
    for (int count : counts) chi_square += std::pow(count - n / 64, 2) / (n / 64);
    EXPECT_LT(chi_square, 63 + 4 * std::sqrt(126.0));
}

TEST(InterleavedGradient, IsTheFormula) {
    double worst = 0;
    for (uint frame : {0u, 1u, 5u, 63u, 64u, 1000003u})
        for (uint y = 0u; y < 2160u; y += 37u)
            for (uint x = 0u; x < 3840u; x += 41u) {
                const double shift = 5.588238 * (frame % 64u);
                const double inner = fract(0.06711056 * (x + shift) + 0.00583715 * (y + shift));
                const double expected = fract(52.9829189 * inner);
                worst = std::max(worst, distance(glsl::interleaved_gradient_offset(uvec2(x, y), frame), expected));
            }
    EXPECT_LT(worst, 1e-4);
}

// What it was made for. Nine ninths, shifted by any value, have a mean of 0.5 with a deviation of 1/18/sqrt(3) =
// 0.032; white noise has 0.096.
TEST(InterleavedGradient, AnyNinePixelsAreSpreadEvenly) {
    double squares = 0;
    for (uint y = 0u; y < 100u; ++y)
        for (uint x = 0u; x < 100u; ++x) {
            double mean = 0;
            for (uint i = 0u; i < 9u; ++i)
                mean += glsl::interleaved_gradient_offset(uvec2(x + i % 3u, y + i / 3u), 0u) / 9;
            squares += std::pow(mean - 0.5, 2) / 1e4;
        }
    EXPECT_LT(std::sqrt(squares), 0.042);
}

// By the theorem of three distances the gaps after F_n frames, F_n a Fibonacci number, are of two lengths, the
// longer 1.1708 / F_n or a little more.
TEST(GoldenRatio, FramesAreSpreadEvenlyFromAnyOneOn) {
    for (const uint first : {0u, 777u, 4000000000u})
        for (const uint frames : {8u, 21u, 55u})
            for (const float v : {0.001f, 0.5f, 0.77f}) {
                std::vector<double> offsets;
                for (uint i = 0u; i < frames; ++i) offsets.push_back(glsl::golden_ratio_offset(v, first + i));
                std::sort(offsets.begin(), offsets.end());
                double gap = offsets.front() + 1 - offsets.back();
                for (std::size_t i = 1; i < offsets.size(); ++i) gap = std::max(gap, offsets[i] - offsets[i - 1]);
                EXPECT_LT(gap * frames, 1.18) << first << ' ' << frames;
            }
    const double ratio = 2 / (1 + std::sqrt(5.0));
    for (const uint frame : {1u, 100u, 100000u})
        EXPECT_LT(distance(glsl::golden_ratio_offset(0.25f, frame), 0.25 + frame * ratio), 1e-4) << frame;
}

TEST(R2, ShiftsAreTheSequenceAndComeToEveryPlaceEquallyOften) {
    const double p = 1.32471795724474602596;  // p^3 = p + 1
    EXPECT_EQ(glsl::r2_shift(0u, 128u), uvec2(0u));
    for (const uint period : {2u, 8u, 128u})
        for (uint frame = 1u; frame < 1000u; ++frame) {
            const uvec2 shift = glsl::r2_shift(frame, period);
            EXPECT_LT(std::max(shift.x, shift.y), period);
            // Rounded down; a fraction that is a whole number of pixels but for rounding is not among these.
            EXPECT_EQ(shift.x, std::floor(fract(frame / p) * period)) << frame;
            EXPECT_EQ(shift.y, std::floor(fract(frame / p / p) * period)) << frame;
        }
    const uint period = 8u, frames = 64u * 64u;
    std::map<std::pair<uint, uint>, int> counts;
    for (uint frame = 4000000000u; frame < 4000000000u + frames; ++frame) {
        const uvec2 shift = glsl::r2_shift(frame, period);
        ++counts[{shift.x, shift.y}];
    }
    EXPECT_EQ(counts.size(), 64u);
    for (const auto& [shift, count] : counts) EXPECT_NEAR(count, 64, 6);
}

}  // namespace
