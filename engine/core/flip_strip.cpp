#include "engine/core/flip_strip.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

void add_scaled(float* out, const float* in, float weight, int count) {
    for (int x = 0; x < count; ++x) out[x] += weight * in[x];
}

void filter_row(float* out, const float* padded, int padding, const FlipKernel& kernel, int width) {
    const int radius = static_cast<int>(kernel.size() / 2);
    std::fill_n(out, width, 0.0f);
    for (std::size_t i = 0; i < kernel.size(); ++i)
        add_scaled(out, padded + padding - radius + static_cast<int>(i), kernel[i], width);
}

void pad(std::vector<float>& row, int padding) {
    std::fill_n(row.begin(), padding, row[static_cast<std::size_t>(padding)]);
    std::fill_n(row.end() - padding, padding, *(row.end() - padding - 1));
}

}  // namespace

void FlipStrip::filter_rows(const FlipRows& rows, int begin, int end) {
    const int padding = kernels_.radius;
    first_row_ = std::max(begin - padding, 0);
    const int last = std::min(end + padding, height_);
    const auto width = static_cast<std::size_t>(width_);
    for (std::vector<float>& plane : planes_) plane.resize(width * static_cast<std::size_t>(last - first_row_));

    // Y, and the opponent colours X - Y and Y - Z: linear in YyCxCz, and so are the filters.
    std::vector<float> a(width + 2 * static_cast<std::size_t>(padding)), b(a), c(a);
    for (int y = first_row_; y < last; ++y) {
        rows(y, &a[padding], &b[padding], &c[padding]);
        for (int x = padding; x < padding + width_; ++x) {
            const FlipColor xyz = relative_xyz({a[x], b[x], c[x]});
            a[x] = xyz.y;
            b[x] = xyz.x - xyz.y;
            c[x] = xyz.y - xyz.z;
        }
        for (std::vector<float>* row : {&a, &b, &c}) pad(*row, padding);
        const std::size_t at = width * static_cast<std::size_t>(y - first_row_);
        const auto filter = [&](Plane plane, const std::vector<float>& row, const FlipKernel& kernel) {
            filter_row(&planes_[plane][at], row.data(), padding, kernel, width_);
        };
        filter(achromatic, a, kernels_.achromatic);
        filter(red_green, b, kernels_.red_green);
        filter(blue_yellow_0, c, kernels_.blue_yellow[0]);
        filter(blue_yellow_1, c, kernels_.blue_yellow[1]);
        filter(gaussian, a, kernels_.gaussian);
        filter(edge, a, kernels_.edge);
        filter(point, a, kernels_.point);
    }
}

void FlipStrip::filter_column(Plane plane, const FlipKernel& kernel, int y, std::vector<float>& out) const {
    const int radius = static_cast<int>(kernel.size() / 2);
    std::ranges::fill(out, 0.0f);
    for (int i = -radius; i <= radius; ++i) {
        const int row = std::clamp(y + i, 0, height_ - 1) - first_row_;
        add_scaled(out.data(), &planes_[plane][static_cast<std::size_t>(row) * static_cast<std::size_t>(width_)],
                   kernel[static_cast<std::size_t>(i + radius)], width_);
    }
}

void FlipStrip::perceive(const FlipRows& rows, int begin, int end, std::vector<FlipPercept>& out) {
    filter_rows(rows, begin, end);
    const auto width = static_cast<std::size_t>(width_);
    out.resize(width * static_cast<std::size_t>(end - begin));
    std::vector<float> luma(width), rg(width), by[2] = {luma, luma}, edges[2] = {luma, luma},
                                               points[2] = {luma, luma};
    for (int y = begin; y < end; ++y) {
        filter_column(achromatic, kernels_.achromatic, y, luma);
        filter_column(red_green, kernels_.red_green, y, rg);
        filter_column(blue_yellow_0, kernels_.blue_yellow[0], y, by[0]);
        filter_column(blue_yellow_1, kernels_.blue_yellow[1], y, by[1]);
        filter_column(edge, kernels_.gaussian, y, edges[0]);
        filter_column(gaussian, kernels_.edge, y, edges[1]);
        filter_column(point, kernels_.gaussian, y, points[0]);
        filter_column(gaussian, kernels_.point, y, points[1]);
        FlipPercept* row = &out[width * static_cast<std::size_t>(y - begin)];
        for (std::size_t x = 0; x < width; ++x) {
            const float z_opponent =
                kernels_.blue_yellow_share[0] * by[0][x] + kernels_.blue_yellow_share[1] * by[1][x];
            const FlipColor filtered{luma[x] + rg[x], luma[x], luma[x] - z_opponent};
            row[x].color = hunt_lab(relative_xyz(clamped_rgb(filtered)));
            row[x].edge = std::sqrt(edges[0][x] * edges[0][x] + edges[1][x] * edges[1][x]);
            row[x].point = std::sqrt(points[0][x] * points[0][x] + points[1][x] * points[1][x]);
        }
    }
}

}  // namespace tyndall
