#include "reference/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::reference {
namespace {

constexpr double pi = std::numbers::pi;
/// What the scene's materials mean by less: a mirror shows a point light as nothing or as infinity.
constexpr double least_roughness = 0.045;
/// Interpolated and bent normals may turn away from the eye; they count as seen from the other side.
constexpr double least_n_dot_v = 1e-4;

}  // namespace

Brdf::Brdf(const Surface& surface, dvec3 to_eye)
    : normal_(surface.normal),
      to_eye_(to_eye),
      n_dot_v_(std::max(std::abs(glm::dot(surface.normal, to_eye)), least_n_dot_v)) {
    // Any frame around the normal.
    const dvec3 aside = std::abs(normal_.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    tangent_ = glm::normalize(glm::cross(aside, normal_));
    bitangent_ = glm::cross(normal_, tangent_);
    const double alpha = std::pow(std::clamp(surface.roughness, least_roughness, 1.0), 2);
    alpha2_ = alpha * alpha;
    const double metallic = surface.metallic, dielectric = surface.dielectric_f0;
    f0_ = (1 - metallic) * dvec3(dielectric) + metallic * surface.base_color;
    // Lagarde and de Rousiers 2014: what reflects less than 2% head-on has no grazing reflection either.
    f90_ = (1 - metallic) * std::clamp(50 * dielectric, 0.0, 1.0) + metallic;
    albedo_ = (1 - metallic) * surface.base_color;
}

/// Schlick 1994.
dvec3 Brdf::fresnel(double v_dot_h) const {
    return f0_ + (dvec3(f90_) - f0_) * std::pow(1 - std::clamp(v_dot_h, 0.0, 1.0), 5);
}

/// Trowbridge and Reitz 1975: alpha² / (pi (cos² (alpha² - 1) + 1)²).
double Brdf::distribution(double n_dot_h) const {
    if (n_dot_h <= 0) return 0;
    const double cos2 = std::min(n_dot_h * n_dot_h, 1.0);
    return alpha2_ / (pi * std::pow((1 - cos2) + alpha2_ * cos2, 2));
}

/// Smith's masking and shadowing with correlated heights over 4 (n.l) (n.v), Heitz 2014: with Lambda(c) =
/// (-1 + sqrt(1 + alpha² (1/c² - 1))) / 2 it is 1 / (1 + Lambda(n.l) + Lambda(n.v)).
double Brdf::visibility(double n_dot_l) const {
    const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + alpha2_ * (1 / (c * c) - 1)) - 1); };
    return 1 / ((1 + lambda(n_dot_l) + lambda(n_dot_v_)) * 4 * n_dot_l * n_dot_v_);
}

dvec3 Brdf::diffuse(dvec3 to_light) const {
    if (glm::dot(normal_, to_light) <= 0) return dvec3(0);
    const double v_dot_h = glm::dot(to_eye_, glm::normalize(to_light + to_eye_));
    return (dvec3(1) - fresnel(v_dot_h)) * albedo_ / pi;
}

dvec3 Brdf::specular(dvec3 to_light) const {
    const double n_dot_l = glm::dot(normal_, to_light);
    if (n_dot_l <= 0) return dvec3(0);
    const dvec3 h = glm::normalize(to_light + to_eye_);
    return fresnel(glm::dot(to_eye_, h)) * (distribution(glm::dot(normal_, h)) * visibility(n_dot_l));
}

// int D cos dh up to theta is u for tan² theta = alpha² u / (1 - u).
dvec3 Brdf::half_vector(double u, double cos_azimuth, double sin_azimuth) const {
    const double cos2 = (1 - u) / (1 - u + alpha2_ * u), sine = std::sqrt(1 - cos2);
    return std::sqrt(cos2) * normal_ + sine * (cos_azimuth * tangent_ + sin_azimuth * bitangent_);
}

// The density of l is D (n.h) / (4 v.h); D cancels.
dvec3 Brdf::specular_weight(dvec3 half_vector, dvec3 to_light) const {
    const double n_dot_l = glm::dot(normal_, to_light), v_dot_h = glm::dot(to_eye_, half_vector);
    const double n_dot_h = glm::dot(normal_, half_vector);
    if (n_dot_l <= 0 || v_dot_h <= 0 || n_dot_h <= 0) return dvec3(0);
    return fresnel(v_dot_h) * (visibility(n_dot_l) * 4 * v_dot_h * n_dot_l / n_dot_h);
}

dvec3 reflected(const Surface& surface, dvec3 to_eye, dvec3 to_light) {
    const double n_dot_l = glm::dot(surface.normal, to_light);
    if (n_dot_l <= 0) return dvec3(0);
    const Brdf brdf(surface, to_eye);
    return (brdf.diffuse(to_light) + brdf.specular(to_light)) * n_dot_l;
}

}  // namespace tyndall::reference
