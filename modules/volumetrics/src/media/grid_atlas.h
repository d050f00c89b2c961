#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/gl/texture.h"
#include "volumetrics/density_grid.h"

namespace tyndall::volumetrics {

using Grids = std::vector<std::shared_ptr<const DensityGrid>>;

/// Density grids as shaders/volumetrics/media/grid.glsl reads them, before they are textures. Values are parts of
/// the grid's greatest, in 16 bits: wrong by at most 1 / 131,070 of it. Level 0 are the voxels; each level is the
/// mean over 2^3 of the one before.
struct GridPages {
    std::vector<std::uint32_t> pages;   ///< headers, then per level a page for each brick
    glm::ivec3 bricks{0};               ///< along the axes of the atlas
    std::vector<std::uint16_t> values;  ///< of the atlas, x fastest
};

/// Throws Error for grids that are too large for it.
[[nodiscard]] GridPages grid_pages(std::span<const std::shared_ptr<const DensityGrid>> grids);

/// Those textures. They are kept until the grids change.
class GridAtlas {
  public:
    void prepare(const Grids& grids);
    void release() { *this = {}; }
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    Grids grids_;
    gl::Texture pages_, bricks_;
};

}  // namespace tyndall::volumetrics
