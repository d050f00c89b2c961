#pragma once

#include "checks.h"
#include "random.h"
#include "tally.h"
#include "worlds.h"

namespace tyndall::stress {

/// Holds comparable frames to truths, on renderers of its own, so that what it draws leaves nothing in the run's.
class Compare {
  public:
    explicit Compare(ShaderLibrary& shaders) : worlds_(shaders) {}
    /// `random` chooses the pixels.
    void check(const StressFrame& frame, Random random, Findings& findings);
    /// Of any frame: with all light doubled, the same picture, twice as bright.
    void check_doubled(const StressFrame& frame, Findings& findings);
    Tally tally;

  private:
    [[nodiscard]] std::vector<Layers> draw(const StressFrame& frame, const Scene& scene,
                                           const StressOptions& options, int frames);
    Worlds worlds_;
};

}  // namespace tyndall::stress
