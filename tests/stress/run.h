#pragma once

#include "checks.h"
#include "compare.h"
#include "random.h"
#include "worlds.h"

namespace tyndall::stress {

struct Totals {
    int frames = 0, failed = 0;
    long long depth_pixels = 0;  ///< whose transmittance was compared with that behind the surface
};

/// Draws frames and checks them; a frame of the middle of a sequence is preceded by the frames before it.
class Run {
  public:
    explicit Run(std::uint64_t seed);
    /// Draws a frame as the next one.
    void draw(int number);
    /// Draws and checks it.
    [[nodiscard]] Findings check(int number);
    /// From a fresh start, the frames of the sequence before it and then the frame: is anything wrong with it?
    [[nodiscard]] bool fails_alone(int number);
    Totals totals;
    [[nodiscard]] const Tally& tally() const { return compare_.tally; }

  private:
    Layers render(const StressFrame& frame, World world);
    std::uint64_t seed_;
    ShaderLibrary shaders_;
    Worlds worlds_;
    Compare compare_;
};

}  // namespace tyndall::stress
