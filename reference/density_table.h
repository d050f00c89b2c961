#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace tyndall::reference {

/// The integral of a density along a ray, from its first knot to anywhere: panels, as fine as its accuracy asks
/// for, with the antiderivative of the polynomial through 9 Chebyshev points.
class DensityTable {
  public:
    DensityTable() = default;
    /// `knots` rise; between them the density is smooth. `tolerance`: absolute, of the whole integral.
    DensityTable(const std::function<double(double)>& density, std::span<const double> knots, double tolerance);
    [[nodiscard]] bool empty() const { return panels_.empty(); }
    [[nodiscard]] double integral_to(double t) const;  ///< constant outside the knots

  private:
    static constexpr int degree = 8;
    struct Panel {
        double begin, end;
        double before = 0, error = 0;
        std::array<double, degree + 2> antiderivative{};  ///< Chebyshev coefficients; 0 at `begin`
        [[nodiscard]] double integral_to(double t) const;
    };
    [[nodiscard]] static Panel fit(const std::function<double(double)>& density, double begin, double end);
    std::vector<Panel> panels_;
};

}  // namespace tyndall::reference
