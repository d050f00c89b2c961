#pragma once

#include <vector>

namespace tyndall {

/// Holds the time that frames take by the number of pixels of the scene's picture: dynamic resolution. From five
/// frames on, of which it takes the median, so that a frame that compiles a shader does not count, it lowers the
/// scale where they take more than their budget, and raises it by little where there is time left. Between the
/// two lies a range in which nothing changes: there a picture of 15% more pixels would not fit.
class FrameBudget {
  public:
    /// ms a frame; scales as those of PlayChoice.
    FrameBudget(double budget, float least, float most) : budget_(budget), least_(least), most_(most) {}
    /// Once a frame: what the scale becomes after a frame of `ms` at `scale`.
    [[nodiscard]] float next(float scale, double ms);

  private:
    double budget_;
    float least_, most_;
    std::vector<double> frames_;  ///< ms, since the last look at them
};

}  // namespace tyndall
