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

/// Smith's Lambda: microfacets hidden from a direction, per one that is seen.
double Brdf::lambda(double cosine) const {
    return 0.5 * (std::sqrt(1 + alpha2_ * (1 / (cosine * cosine) - 1)) - 1);
}

/// Smith's masking and shadowing with correlated heights, Heitz 2014, over 4 (n.l) (n.v).
double Brdf::visibility(double n_dot_l) const {
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

// Heitz 2018, "Sampling the GGX Distribution of Visible Normals": stretched by alpha the microfacets are a
// hemisphere, whose visible ones are a disc seen askew. The weight is F G2 / G1 = F (1 + Lambda(v)) / (1 +
// Lambda(v) + Lambda(l)).
Brdf::Sample Brdf::sample(double u, double cos_azimuth, double sin_azimuth) const {
    const double alpha = std::sqrt(alpha2_);
    dvec3 v(glm::dot(to_eye_, tangent_), glm::dot(to_eye_, bitangent_), n_dot_v_);
    v = glm::normalize(v);
    const dvec3 stretched = glm::normalize(dvec3(alpha * v.x, alpha * v.y, v.z));
    const double aside = std::hypot(stretched.x, stretched.y);
    const dvec3 first = aside > 0 ? dvec3(-stretched.y, stretched.x, 0) / aside : dvec3(1, 0, 0);
    const dvec3 second = glm::cross(stretched, first);
    const double x = std::sqrt(u) * cos_azimuth, half = 0.5 * (1 + stretched.z);
    const double y = (1 - half) * std::sqrt(1 - x * x) + half * std::sqrt(u) * sin_azimuth;
    const dvec3 up = x * first + y * second + std::sqrt(std::max(1 - x * x - y * y, 0.0)) * stretched;
    const dvec3 h = glm::normalize(dvec3(alpha * up.x, alpha * up.y, std::max(up.z, 0.0)));

    const double v_dot_h = glm::dot(v, h);
    const dvec3 l = 2 * v_dot_h * h - v;
    Sample sample{l.x * tangent_ + l.y * bitangent_ + l.z * normal_, dvec3(0)};
    if (l.z > 0) sample.weight = fresnel(v_dot_h) * ((1 + lambda(v.z)) / (1 + lambda(v.z) + lambda(l.z)));
    return sample;
}

dvec3 reflected(const Surface& surface, dvec3 to_eye, dvec3 to_light) {
    const double n_dot_l = glm::dot(surface.normal, to_light);
    if (n_dot_l <= 0) return dvec3(0);
    const Brdf brdf(surface, to_eye);
    return (brdf.diffuse(to_light) + brdf.specular(to_light)) * n_dot_l;
}

}  // namespace tyndall::reference
