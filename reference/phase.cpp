#include "reference/phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::reference {
namespace {

constexpr double sharpest = 0.999;
constexpr double per_sphere = 1 / (4 * std::numbers::pi);

double schlick_k(double g) {
    return std::clamp(1.55 * g - 0.55 * g * g * g, -sharpest, sharpest);
}

}  // namespace

// (1 - g²) / (4 pi (1 + g² - 2 g cos)^1.5)
double henyey_greenstein(double g, double cos_theta) {
    g = std::clamp(g, -sharpest, sharpest);
    const double squared = 1 + g * (g - 2 * cos_theta);
    return per_sphere * (1 - g * g) / (squared * std::sqrt(squared));
}

// (1 - k²) / (4 pi (1 - k cos)²)
double schlick(double g, double cos_theta) {
    const double k = schlick_k(g);
    const double root = 1 - k * cos_theta;
    return per_sphere * (1 - k * k) / (root * root);
}

double henyey_greenstein_peak(double g) {
    return henyey_greenstein(std::abs(g), 1);
}

double schlick_peak(double g) {
    return schlick(std::abs(g), 1);
}

}  // namespace tyndall::reference
