#pragma once

#include "engine/gl/texture.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// What passes along epipolar lines keep: the table of lights, which the CPU writes.
struct KeptTable : Kept {
    gl::Texture texture;
    [[nodiscard]] std::size_t bytes() const override { return texture ? gl::byte_size(texture.desc()) : 0; }
};

/// The technique epipolar, of all lamps or of FrameMedia::few_lamps alone. Empty, with its reason in the pass list,
/// where the host has no shadow maps to ask.
[[nodiscard]] Estimate add_epipolar(Frame& frame, bool few_lamps);
[[nodiscard]] const std::vector<std::string>& epipolar_passes();

}  // namespace tyndall::volumetrics
