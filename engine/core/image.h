#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace tyndall {

/// A picture in memory: rows from top to bottom, channels interleaved, linear 32-bit float.
struct Image {
    glm::ivec2 size{0};
    int channels = 4;
    std::vector<float> pixels;  ///< size.x * size.y * channels

    Image() = default;
    Image(glm::ivec2 size_, int channels_)
        : size(size_), channels(channels_), pixels(std::size_t(size_.x) * size_.y * channels_) {}
    [[nodiscard]] float* at(int x, int y) { return &pixels[(std::size_t(y) * size.x + x) * channels]; }
    [[nodiscard]] const float* at(int x, int y) const { return &pixels[(std::size_t(y) * size.x + x) * channels]; }
};

/// Reads PNG, JPEG, EXR, HDR. 8 and 16 bit integers become 0..1 (no transfer curve is applied); EXR is as stored.
/// Alpha is straight. Throws Error naming the path. `channels` 0 keeps the file's count; otherwise grey fills red,
/// green and blue, other missing channels are 0, alpha 1.
[[nodiscard]] Image read_image(const std::filesystem::path& path, int channels = 0);
/// Decodes a picture that lies in memory (an image embedded in a glTF buffer). `name` is for the error message.
[[nodiscard]] Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, int channels = 4);
/// Writes .png or .jpg (8 bit, values clamped to 0..1 and rounded, no transfer curve) or .exr (32-bit float), by
/// extension, atomically. Throws Error naming the path (unknown extension, unwritable).
void write_image(const std::filesystem::path& path, const Image& image);

/// Error metrics of `a` against the reference `b` over the first three channels. Throws Error when sizes differ.
struct ImageDifference {
    double rmse;    ///< sqrt(mean((a-b)^2)) over pixels and channels
    double relmse;  ///< mean((a-b)^2 / (b^2 + 0.01)): Rousselle et al. 2011, "Adaptive Sampling and
                    ///< Reconstruction", eq. 4 with eps 0.01
    double psnr;    ///< 20 log10(peak / rmse), peak 1 for 8-bit pictures, max(b) otherwise; +inf when equal
    double max;     ///< max |a-b|
};
[[nodiscard]] ImageDifference compare_images(const Image& a, const Image& b, double peak = 1.0);
/// |a-b| mean over channels, shown from black through red and yellow to white at `white`.
[[nodiscard]] Image difference_heatmap(const Image& a, const Image& b, float white);

}  // namespace tyndall
