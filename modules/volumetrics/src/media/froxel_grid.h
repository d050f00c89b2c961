#pragma once

#include "shaders/shared/volumetrics.h"
#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// The columns and slices of the froxels of a picture: those that are set, but columns no narrower or lower than
/// `froxels.pixels`, of which it has so many that all are seen, in steps of 8 across and 4 up. The noise of local
/// media keeps the columns that are set.
[[nodiscard]] glm::ivec3 froxel_size(const Settings& settings, glm::ivec2 picture);

/// The froxel volume: size, and the view depths [m] its slices divide (shaders/lib/froxel.glsl).
struct FroxelGrid {
    glm::ivec3 size;
    int distribution;                    ///< FROXEL_*
    float nearest, farthest;             ///< view depths
    glm::mat4 begins{0.0F}, lengths{0};  ///< FROXEL_TABLE: each of 16 shares of the slices

    /// Place in the volume, 0..1, of a view depth [m], and back; outside the volume the result lies outside [0,1].
    [[nodiscard]] float w(float view_depth) const;
    [[nodiscard]] float view_depth(float w) const;
};
[[nodiscard]] FroxelGrid froxel_grid(const Inputs& inputs, const Settings& settings);

/// View depth at 0, 1/16 … 16/16 of the slices, rising. The least length is kept above what single precision
/// resolves at the far end, also when it is cut into 16 slices.
using DepthTable = std::array<float, 17>;
/// Of the distribution `auto`, see froxel_auto.cpp.
[[nodiscard]] DepthTable automatic_depths(const Inputs& inputs, const Settings& settings);

}  // namespace tyndall::volumetrics
