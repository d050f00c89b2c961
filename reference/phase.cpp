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

// (1 - g²) (1 + cos²) / ((2 + g²) (1 + g² - 2 g cos)^1.5), with the factor that makes its integral 1
double cornette_shanks(double g, double cos_theta) {
    g = std::clamp(g, -sharpest, sharpest);
    const double g2 = g * g, squared = 1 + g2 - 2 * g * cos_theta;
    return 1.5 * per_sphere * (1 - g2) / (2 + g2) * (1 + cos_theta * cos_theta) / std::pow(squared, 1.5);
}

// The factor's mean is 1 + alpha <cos²>, and <cos²> of Henyey-Greenstein, whose second Legendre moment is g², (1 +
// 2 g²) / 3.
double draine(double g, double alpha, double cos_theta) {
    return henyey_greenstein(g, cos_theta) * (1 + alpha * cos_theta * cos_theta) /
           (1 + alpha / 3 * (1 + 2 * g * g));
}

double droplets(double diameter, double cos_theta) {
    const double sharp = std::exp(-0.0990567 / (diameter - 1.67154));
    const double wide = std::exp(-0.428934 - 2.20679 / (diameter + 3.91029));
    const double alpha = std::exp(3.62489 - 8.29288 / (diameter + 5.52825));
    const double in_wide = std::exp(-0.665888 - 0.599085 / (diameter - 0.641583));
    return std::lerp(henyey_greenstein(sharp, cos_theta), draine(wide, alpha, cos_theta), in_wide);
}

double rayleigh(double cos_theta) {
    return 0.75 * per_sphere * (1 + cos_theta * cos_theta);
}

double henyey_greenstein_peak(double g) {
    return henyey_greenstein(std::abs(g), 1);
}

double schlick_peak(double g) {
    return schlick(std::abs(g), 1);
}

double cornette_shanks_peak(double g) {
    return cornette_shanks(std::abs(g), 1);
}

double droplets_peak(double diameter) {
    return droplets(diameter, 1);
}

double rayleigh_peak() {
    return rayleigh(1);
}

double ParticlePhase::operator()(double g, double cos_theta) const {
    switch (kind) {
        case Kind::henyey_greenstein:
            break;
        case Kind::schlick:
            return schlick(g, cos_theta);
        case Kind::cornette_shanks:
            return cornette_shanks(g, cos_theta);
        case Kind::double_henyey_greenstein:
            return (1 - back_weight) * henyey_greenstein(g, cos_theta) +
                   back_weight * henyey_greenstein(back_anisotropy, cos_theta);
        case Kind::hg_draine:
            return droplets(droplet_diameter, cos_theta);
    }
    return henyey_greenstein(g, cos_theta);
}

double ParticlePhase::peak(double g) const {
    switch (kind) {
        case Kind::henyey_greenstein:
            break;
        case Kind::schlick:
            return schlick_peak(g);
        case Kind::cornette_shanks:
            return cornette_shanks_peak(g);
        case Kind::double_henyey_greenstein:
            return std::max(henyey_greenstein_peak(g), henyey_greenstein_peak(back_anisotropy));
        case Kind::hg_draine:
            return droplets_peak(droplet_diameter);
    }
    return henyey_greenstein_peak(g);
}

}  // namespace tyndall::reference
