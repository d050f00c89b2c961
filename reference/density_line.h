#pragma once

#include <array>
#include <vector>

namespace tyndall::reference {

/// A density along a ray, piecewise cubic, and its integral from the beginning to anywhere.
class DensityLine {
  public:
    /// Stretches are added in rising order. The density is that at begin, at 1/3, at 2/3 and at end, and cubic.
    void add(double begin, double end, const std::array<double, 4>& density);

    [[nodiscard]] double integral_to(double t) const;
    /// The ends of all stretches, rising.
    [[nodiscard]] std::vector<double> knots() const;

  private:
    struct Stretch {
        double begin, end;
        double before;                         ///< integral of what lies before
        std::array<double, 4> antiderivative;  ///< of powers 1 to 4 of (t - begin) / (end - begin)
        [[nodiscard]] double integral_to(double t) const;
    };
    std::vector<Stretch> stretches_;
};

}  // namespace tyndall::reference
