#pragma once

#include <span>
#include <vector>

#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// Between samples and picture, each where settings ask for it:
///     temporal (before) -> spatial filter -> up-sampling -> refining -> temporal (after) -> relight
/// The filter takes what is sampled per pixel, temporal what is sampled at all, up-sampling all; refining draws
/// what is exact of density grids at the host's resolution where the low one is too coarse; relight makes of the
/// rest and the parts one light, at the host's resolution.
[[nodiscard]] Outputs reconstruct(Frame& frame, Estimate estimate);
/// Names of its passes, with depth_downsample.
[[nodiscard]] const std::vector<std::string>& reconstruction_passes();

/// Why a technique leaves all light in Estimate::scattering instead of in parts: nothing would come of it with
/// these settings. Null: it does not.
[[nodiscard]] const char* reason_for_no_parts(const Settings& settings);
/// A mean over frames is asked for, of a technique whose samples differ from frame to frame.
[[nodiscard]] bool averages_frames(const Settings& settings);
/// Pixels of the host along each side of one pixel that the technique draws: 1, 2 or 4.
[[nodiscard]] int resolution_factor(const Settings& settings);

/// Sets Frame::size and Frame::depth to what the technique draws to.
void add_depth_downsample(Frame& frame);
/// What is drawn at Frame::size can be hidden by Frame::depth.
[[nodiscard]] bool is_depth_buffer(const Frame& frame);

/// The steps of reconstruct. Each replaces the textures it is given.
using Textures = std::span<TextureRef* const>;
/// Two passes at Frame::size. With `frames` (y: frames in the mean that each pixel is) the kernel is the narrower
/// the more there are.
void add_filter(Frame& frame, Textures textures, TextureRef frames);
/// From Frame::size to the host's.
void add_upsample(Frame& frame, Textures textures);
/// Where `low` is too coarse for density grids, draws again what is exact of it, into the up-sampled estimate.
void add_refine(Frame& frame, const Estimate& low, Estimate& estimate);
struct TemporalMean {
    TextureRef acceptance;  ///< see Outputs, where Inputs::acceptance asks for it
    TextureRef frames;      ///< float, y: frames in the mean, 1 … 256
};
/// The mean over frames; settings.temporal.mode is not off. At Frame::size, or the host's where temporal_place is
/// after.
[[nodiscard]] TemporalMean add_temporal(Frame& frame, Textures textures);
/// There are parts.
void add_relight(Frame& frame, Estimate& estimate);

/// PASS/NAME of what a pass makes of a texture PASS_BEFORE/NAME.
[[nodiscard]] std::string name_after(const std::string& pass, const PassList::TextureInfo& source);
/// A new texture of the format of `source`, named after the pass and it.
[[nodiscard]] TextureRef create_like(Frame& frame, const std::string& pass, TextureRef source, glm::ivec2 size);

}  // namespace tyndall::volumetrics
