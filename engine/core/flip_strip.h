#pragma once

#include <functional>
#include <vector>

#include "engine/core/flip_color.h"
#include "engine/core/flip_kernels.h"

namespace tyndall {

/// What FLIP compares of a pixel.
struct FlipPercept {
    FlipColor color;    ///< filtered by the eye's contrast sensitivity; CIELAB with the Hunt effect
    float edge, point;  ///< length of the gradient, and of the second derivatives
};

/// Fills red, green and blue of row y: linear, 0..1, one plane a channel.
using FlipRows = std::function<void(int y, float* red, float* green, float* blue)>;

/// Percepts of rows [begin, end) of a picture, whose border pixels go on outside. Keeps its buffers between calls.
class FlipStrip {
  public:
    FlipStrip(const FlipKernels& kernels, int width, int height)
        : kernels_(kernels), width_(width), height_(height) {}
    void perceive(const FlipRows& rows, int begin, int end, std::vector<FlipPercept>& out);

  private:
    enum Plane { achromatic, red_green, blue_yellow_0, blue_yellow_1, gaussian, edge, point, plane_count };
    void filter_rows(const FlipRows& rows, int begin, int end);
    void filter_column(Plane plane, const FlipKernel& kernel, int y, std::vector<float>& out) const;

    const FlipKernels& kernels_;
    int width_, height_;
    int first_row_ = 0;                       ///< of the filtered rows kept in planes_
    std::vector<float> planes_[plane_count];  ///< horizontally filtered rows
};

}  // namespace tyndall
