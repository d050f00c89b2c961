#pragma once

#include <glm/ext/vector_uint4.hpp>
#include <string>
#include <vector>

#include "engine/core/roots.h"
#include "engine/gl/buffer.h"
#include "engine/gl/texture.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// The tile of sample offsets in (0, 1), rows of `size`: of bayer, or of white_tile a shuffle of the same n^2
/// values; else the one value 0.5.
[[nodiscard]] std::vector<float> noise_tile(Noise noise, int size);

/// Its side: 1 where there is no tile.
[[nodiscard]] int noise_side(const Settings& settings);

/// VolumetricsData::noise. Where noise does not change in time the frame is 0; a tile's own way is the golden
/// ratio.
[[nodiscard]] glm::uvec4 noise_uniform(const Settings& settings, std::uint32_t frame_index);

/// The texture of blue, stbn and fast in assets/noise, NAME_128x128x32_r8.raw; "" for other noise.
[[nodiscard]] std::string noise_texture_name(const Settings& settings);

/// What shaders/volumetrics/reconstruction/noise_offset.glsl reads.
class NoiseSource {
  public:
    /// Makes the tile and loads the texture that the settings ask for, where they are not there yet; frees both
    /// with a technique that samples no noise. Throws Error if the file is missing in `roots` or has another size.
    void prepare(const Settings& settings, const Roots& roots);
    /// Tile and texture, without a sampler object.
    void bind() const;
    void release() { *this = {}; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::string name_;  ///< of what is there: noise, size of the tile, texture
    gl::Buffer tile_;
    gl::Texture texture_;
};

}  // namespace tyndall::volumetrics
