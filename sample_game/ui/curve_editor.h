#pragma once

#include "volumetrics/settings.h"

namespace tyndall {

/// The curve of `froxel_distribution` curve, share of the slices to view depth, as points to drag up and down:
/// whatever is dragged, it rises. Ticks at the right are slices. The depth axis is logarithmic, 1/64 of it where it
/// begins. Draws at the cursor of the current Dear ImGui window.
void curve_editor(volumetrics::Settings& settings);

/// Height of a share of the depth on that axis, 0..1 upwards, and back.
[[nodiscard]] float curve_axis(float depth_share);
[[nodiscard]] float curve_depth(float height);

/// Moves point 1 … 7 to a share of the depth, at most to its neighbours; the others stay.
void move_curve_point(volumetrics::Settings& settings, int point, float depth_share);

/// Of the drawing, px.
constexpr float curve_height = 160;

}  // namespace tyndall
