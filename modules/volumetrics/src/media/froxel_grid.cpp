#include "media/froxel_grid.h"

#include <algorithm>

#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/froxel.glsl"
TYNDALL_GLSL_END

namespace tyndall::volumetrics {
namespace {

void set_table(const DepthTable& depths, FroxelGrid& grid) {
    grid.distribution = glsl::FROXEL_TABLE;
    const float least = 1e-4F * depths.back();
    float begin = depths.front();
    for (int i = 0; i < 16; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const float length = std::max(depths[k + 1] - begin, least);
        grid.begins[i / 4][i % 4] = begin;
        grid.lengths[i / 4][i % 4] = length;
        begin += length;
    }
    grid.nearest = depths.front();
    grid.farthest = begin;
}

DepthTable curve_depths(const Settings& settings) {
    DepthTable depths = froxel_curve(settings);
    for (float& depth : depths) depth *= settings.froxels.far;
    return depths;
}

}  // namespace

float FroxelGrid::w(float view_depth) const {
    return distribution == glsl::FROXEL_TABLE
               ? glsl::froxel_w_from_table(view_depth, begins, lengths)
               : glsl::froxel_w_from_view_depth(distribution, view_depth, nearest, farthest);
}

float FroxelGrid::view_depth(float w) const {
    return distribution == glsl::FROXEL_TABLE ? glsl::froxel_view_depth_from_table(w, begins, lengths)
                                              : glsl::froxel_view_depth_from_w(distribution, w, nearest, farthest);
}

glm::ivec3 froxel_size(const Settings& settings, glm::ivec2 picture) {
    const FroxelSettings& froxels = settings.froxels;
    const glm::ivec3 all{froxels.x, froxels.y, froxels.z};
    if (froxels.pixels == 0) return all;
    const glm::ivec2 step{8, 4};
    const glm::ivec2 columns = (picture + froxels.pixels - 1) / froxels.pixels;
    return {glm::min(glm::ivec2(all), glm::max((columns + step - 1) / step * step, glm::ivec2(8))), all.z};
}

FroxelGrid froxel_grid(const Inputs& inputs, const Settings& settings) {
    FroxelGrid grid{.size = froxel_size(settings, inputs.size),
                    .distribution = glsl::FROXEL_LINEAR,
                    .nearest = inputs.znear,
                    .farthest = settings.froxels.far};
    switch (settings.froxels.distribution) {
        case DepthDistribution::linear:
            break;
        case DepthDistribution::exponential:
            grid.distribution = glsl::FROXEL_EXPONENTIAL;
            // Slices in proportion to their depth would crowd at a near plane of centimetres.
            grid.nearest = std::max(inputs.znear, settings.froxels.far / 256);
            break;
        case DepthDistribution::logarithmic:
            grid.distribution = glsl::FROXEL_LOGARITHMIC;
            grid.nearest = settings.froxels.far / 32;
            break;
        case DepthDistribution::curve:
            set_table(curve_depths(settings), grid);
            return grid;
        case DepthDistribution::automatic:
            set_table(automatic_depths(inputs, settings), grid);
            return grid;
    }
    grid.farthest = std::max(settings.froxels.far, 2 * grid.nearest);
    return grid;
}

// With the slopes d of the eighths, the slope at a point between two of them is their harmonic mean (Fritsch and
// Butland 1984), at most twice the smaller, and so the cubic between the points rises. In the middle of an eighth,
// Hermite's form is (y0 + y1) / 2 + (m0 - m1) / 8.
std::array<float, 17> froxel_curve(const Settings& settings) {
    constexpr std::size_t n = froxel_curve_settings.size();
    double total = 0;
    for (const auto member : froxel_curve_settings) total += static_cast<double>(settings.froxels.*member);
    std::array<double, n> d{};
    for (std::size_t i = 0; i < n; ++i)
        d[i] = static_cast<double>(settings.froxels.*froxel_curve_settings[i]) / total;
    const auto slope = [&](std::size_t i) {
        if (i == 0 || i == n) return i == 0 ? d.front() : d.back();
        return 2 * d[i - 1] * d[i] / (d[i - 1] + d[i]);
    };
    std::array<float, 2 * n + 1> y{};
    double at = 0;
    for (std::size_t i = 0; i < n; ++i) {
        y[2 * i + 1] = static_cast<float>(at + d[i] / 2 + (slope(i) - slope(i + 1)) / 8);
        at += d[i];
        y[2 * i + 2] = static_cast<float>(at);
    }
    return y;
}

}  // namespace tyndall::volumetrics
