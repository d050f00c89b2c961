#pragma once

#include <string>
#include <vector>

#include "light/epipolar.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// The sunlight of all pixels from few samples along the sun's lines
/// (shaders/volumetrics/light/epipolar_sunlight.glsl): some samples ask the trees, the others are interpolated
/// between them, pixels between samples of their surface, and pixels that have none are marched.
class EpipolarSunlight {
  public:
    TextureRef counts;              ///< RG32F, a line: cells that its samples see, samples that ask
    TextureRef unwarped, fixed_up;  ///< RGBA16F of Frame::size

    /// Adds the pass that chooses which samples ask. `table`: EpipolarPlan::table.
    EpipolarSunlight(Frame& frame, const EpipolarLines& sun, TextureRef table);
    /// The others. `nodes`: the lines' trees.
    void add_passes(TextureRef nodes);

  private:
    Frame& frame_;
    EpipolarLines sun_;
    TextureRef table_;
    TextureRef between_, asking_, asked_, interpolated_;

    [[nodiscard]] TextureRef create(const std::string& name, GLenum format) const;
    void add(Pass pass);
    void march(const std::string& name, TextureRef nodes, TextureRef asking, TextureRef wanted, TextureRef& target,
               int rectangles);
};

[[nodiscard]] const std::vector<std::string>& epipolar_sunlight_passes();

/// Axes of programs that march with trees.
[[nodiscard]] bool is_epipolar_permutation(const Permutation& p);
[[nodiscard]] Permutation epipolar_permutation(const Frame& frame);
/// The shader's uniform coarsest_level.
[[nodiscard]] constexpr int coarsest_epipolar_level(bool tree) {
    return tree ? 31 : 0;
}

}  // namespace tyndall::volumetrics
